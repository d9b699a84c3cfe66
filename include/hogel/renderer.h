// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "hogel/export.h"
#include "hogel/light_field.h"
#include "hogel/shading.h"
#include "hogel/table.h"

namespace hogel {

/// A light field that is rendered from a scene when it is read, and that can go on with another scene.
class HOGEL_API Renderer : public LightFieldSource {
  public:
    /// Renders this scene from now on: another one, or the same object with new contents. The light field is that of a
    /// new renderer, to the last bit; memory of the last scene is used again where it suffices. Call it while no other
    /// thread reads; tiles that a cached_tiles() around the renderer holds are out of date afterwards. Throws what
    /// make_renderer() throws; the renderer may then be read only after another scene has been set.
    virtual void set_scene(std::shared_ptr<const ShadedScene> scene) = 0;
};

/// A rendering algorithm.
struct RendererInfo {
    std::string name;  ///< by which make_renderer() finds it
    std::string text;  ///< one line
    /// A light field of the scene, which is shared, never copied. A source that is a Renderer is asked to take the next
    /// scene; any other is made anew for it. Throws Error(usage) for a scene that it cannot render.
    std::function<std::unique_ptr<LightFieldSource>(std::shared_ptr<const ShadedScene> scene,
                                                    const LightFieldGrid& grid)>
        make;
    bool crosses_plane = true;  ///< renders scenes that are not wholly behind the hologram plane
    /// Bytes that rendering a region of hogels at once takes for depth buffers, besides the tile that receives the
    /// values; null where memory does not grow with the region.
    std::function<double(const LightFieldGrid& grid, const HogelRange& region)> depth_buffer_bytes = nullptr;
    bool takes_frequencies = false;  ///< renders light fields whose directions are uniform in sines
};

/// The renderers by name.
HOGEL_API Table<RendererInfo>& renderers();

/// A light field of the scene by the renderer of that name. Offers depth per ray. The scene is shared, never copied.
/// Throws Error(usage) for an unknown name, for a grid uniform in sines where the renderer takes only perspectives, and
/// for a scene that is not wholly behind the hologram plane where the renderer does not cross it.
HOGEL_API std::unique_ptr<Renderer> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                  const LightFieldGrid& grid);

/// Supersampling factors: samples along each side of a hogel, and along each side of the cell around a direction.
/// Together they make hogel² · direction² samples a ray, on a regular grid.
struct SamplesPerRay {
    std::size_t hogel = 1;      ///< along a hogel's side
    std::size_t direction = 1;  ///< along a side of a direction's cell

    /// Samples a ray.
    std::size_t count() const { return hogel * hogel * direction * direction; }
};

/// The sampling whose cells divide those of `grid`. Throws Error(usage) for factors that are not 1 to 64, and for more
/// samples than can be addressed.
HOGEL_API LightFieldGrid finer(const LightFieldGrid& grid, const SamplesPerRay& samples);

/// A light field filtered by a box as wide as a sample's cell in s, t, U and V: each value is the mean of those of
/// `fine`, which has the grid `finer(grid, samples)`. The depth of a ray is the smallest in its cell: it belongs to
/// something that the ray shows, which a mean need not, and things in front keep their outline. Memory of a tile:
/// `fine` in the tile that it prefers, or all samples of one hogel. Throws Error(usage) where `fine` has another grid.
HOGEL_API std::unique_ptr<LightFieldSource> average(std::shared_ptr<const LightFieldSource> fine,
                                                    const LightFieldGrid& grid, const SamplesPerRay& samples);

/// As make_renderer() above, with several samples a ray (see average()).
HOGEL_API std::unique_ptr<Renderer> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                  const LightFieldGrid& grid, const SamplesPerRay& samples);

}  // namespace hogel
