// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench_rows.h"
#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::cli {

/// Another program's way to the samples of a light field, hogel by hogel, used as well as it can be: triangles with
/// the interpolated radiance of their vertices before the scene's background, on thread_count() threads.
class RenderPeer {
  public:
    virtual ~RenderPeer() = default;
    /// So many hogels are worth while at once.
    virtual std::size_t fewest() const = 0;
    /// Renders hogels, whose samples then lie in memory.
    virtual void render(std::span<const HogelPlace> hogels) = 0;
    /// Of hogel i of those: row v, column u.
    virtual Rgb sample(std::size_t i, std::size_t v, std::size_t u) const = 0;
    /// How far its samples are from the truth by their format alone, and where they are clipped.
    virtual float rounding() const { return 0; }
    virtual float largest() const { return std::numeric_limits<float>::infinity(); }
};

/// Embree with coherent rays from one hogel: squares of `side` directions at a time, whose rays travel together; 16
/// for streams of 256 rays, 4 for packets of 16. The tree is built with the best quality that Embree has.
std::unique_ptr<RenderPeer> make_embree_peer(const ShadedScene& scene, const LightFieldGrid& grid, std::size_t side);

/// Mesa's software rasteriser, by OpenGL without a window, with `views` hogels at once: instances of one draw call,
/// each into a layer of its own of 8 bits a channel, and then read back. The scene must lie behind the hologram, on the
/// grid's front face. Throws Error(not_built_in) where Mesa or its header files were not there.
std::unique_ptr<RenderPeer> make_llvmpipe_peer(const ShadedScene& scene, const LightFieldGrid& grid, std::size_t views);

struct RenderPeerInfo {
    std::string name;
    std::unique_ptr<RenderPeer> (*make)(const ShadedScene&, const LightFieldGrid&);
};
/// All of them, by name.
const std::vector<RenderPeerInfo>& render_peers();

}  // namespace hogel::cli
