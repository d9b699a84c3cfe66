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

/// Renderer of another project, used in its fastest way. It renders the samples of a light field hogel by hogel, for
/// triangles with interpolated vertex radiance in front of the scene's background, on thread_count() threads.
class RenderPeer {
  public:
    virtual ~RenderPeer() = default;
    /// Returns the smallest number of hogels that keeps all threads busy.
    virtual std::size_t min_hogels() const = 0;
    /// Renders hogels into memory, for sample().
    virtual void render(std::span<const HogelIndex> hogels) = 0;
    /// Returns the sample at row v, column u of hogel i of the last call of render().
    virtual Rgb sample(std::size_t i, std::size_t v, std::size_t u) const = 0;
    /// Returns the rounding error of its sample format.
    virtual float rounding() const { return 0; }
    /// Returns the radiance above which its format clips samples.
    virtual float max_radiance() const { return std::numeric_limits<float>::infinity(); }
};

/// Returns Embree with coherent rays from one hogel, in squares of `side` directions: 16 for streams of 256 rays, 4 for
/// packets of 16. Its tree is built with Embree's best quality.
std::unique_ptr<RenderPeer> make_embree_peer(const ShadedScene& scene, const LightFieldGrid& grid, std::size_t side);

/// Returns Mesa's software rasteriser, through OpenGL without a window. It renders `views` hogels at once as instances
/// of one draw call, each into its own layer of 8 bits per channel. The scene must be behind the hologram, and the face
/// the front. Throws Error(not_built_in) if Mesa or its header files are missing.
std::unique_ptr<RenderPeer> make_llvmpipe_peer(const ShadedScene& scene, const LightFieldGrid& grid, std::size_t views);

struct RenderPeerInfo {
    std::string name;
    std::unique_ptr<RenderPeer> (*make)(const ShadedScene&, const LightFieldGrid&);
};
const std::vector<RenderPeerInfo>& render_peers();

}  // namespace hogel::bench
