// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/render/rows.h"
#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::bench {

/// Another project's renderer, used as well as it can be: the samples of a light field hogel by hogel, of triangles
/// with the interpolated radiance of their vertices before the scene's background, on thread_count() threads.
class RenderPeer {
  public:
    virtual ~RenderPeer() = default;
    /// The smallest number of hogels that keeps all threads busy.
    virtual std::size_t min_hogels() const = 0;
    /// Renders hogels into memory, for sample().
    virtual void render(std::span<const HogelPlace> hogels) = 0;
    /// Row v, column u of hogel i of those that were rendered last.
    virtual Rgb sample(std::size_t i, std::size_t v, std::size_t u) const = 0;
    /// How much its samples differ from the true ones by their format alone.
    virtual float rounding() const { return 0; }
    /// The radiance above which its format clips samples.
    virtual float max_radiance() const { return std::numeric_limits<float>::infinity(); }
};

/// Embree with coherent rays from one hogel, in squares of `side` directions: 16 for streams of 256 rays, 4 for packets
/// of 16. Its tree is built with the best quality that Embree has.
std::unique_ptr<RenderPeer> make_embree_peer(const ShadedScene& scene, const LightFieldGrid& grid, std::size_t side);

/// Mesa's software rasteriser, by OpenGL without a window. Renders `views` hogels at once: instances of one draw call,
/// each into a layer of its own of 8 bits a channel, which is then read back. The scene must lie behind the hologram,
/// and the grid must be the front face's. Throws Error(not_built_in) where Mesa or its header files are missing.
std::unique_ptr<RenderPeer> make_llvmpipe_peer(const ShadedScene& scene, const LightFieldGrid& grid, std::size_t views);

struct RenderPeerInfo {
    std::string name;
    std::unique_ptr<RenderPeer> (*make)(const ShadedScene&, const LightFieldGrid&);
};
const std::vector<RenderPeerInfo>& render_peers();

}  // namespace hogel::bench
