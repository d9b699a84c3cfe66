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

/// A light field that is rendered from a scene when it is read. The scene can be replaced.
class HOGEL_API Renderer : public LightFieldSource {
  public:
    /// Replaces the scene by another one, or by the same object with new contents. The light field has the same bytes
    /// as that of a new renderer. Memory of the last scene is reused. No other thread may read during the call. Tiles
    /// in a cached_tiles() around the renderer are stale afterwards. Throws as make_renderer() does; after an
    /// exception, set another scene before reading.
    virtual void set_scene(std::shared_ptr<const ShadedScene> scene) = 0;
};

/// Cost of rendering a region of hogels.
struct RenderCost {
    double bytes = 0;             ///< in addition to the tile that receives the values, such as depth buffers
    double bytes_a_triangle = 0;  ///< per triangle of the scene; shared by all regions in progress
    double rays = 0;              ///< extra processor time, in rays of `epi` with a small scene
};

/// A rendering algorithm.
struct RendererInfo {
    std::string name;  ///< for make_renderer()
    std::string text;  ///< one line
    /// Makes a light field of the scene. The scene is shared, not copied. If the source is a Renderer, its set_scene()
    /// receives later scenes; any other source is replaced by a new one for each scene. Throws Error(usage) for a scene
    /// that the algorithm cannot render.
    std::function<std::unique_ptr<LightFieldSource>(std::shared_ptr<const ShadedScene> scene,
                                                    const LightFieldGrid& grid)>
        make;
    bool crosses_plane = true;  ///< can render scenes in front of or across the hologram plane
    double time_of_a_ray = 10;  ///< estimated processor time per ray, in rays of `epi`
    /// Cost of a region; null: RenderCost().
    std::function<RenderCost(const LightFieldGrid& grid, const HogelRange& region, std::size_t triangles)> cost =
        nullptr;
    bool casts_rays = false;         ///< needs Embree; make() throws Error(not_built_in) in builds without it
    bool takes_frequencies = false;  ///< can render directions that are uniform in sines
    /// Can render light fields with a fixed focal plane for any scene. Other renderers get the projection of a scene
    /// that does not reach the plane (docs/renderers.md).
    bool takes_focal_plane = false;
};

/// Returns the renderers by name.
HOGEL_API Table<RendererInfo>& renderers();

/// Makes a light field of the scene, with depth, by the renderer of this name. The scene is shared, not copied. Throws
/// Error(usage) for an unknown name, for a grid uniform in sines if the renderer supports only perspectives, for a
/// scene not wholly behind the hologram plane if the renderer cannot cross it, and for a scene that reaches a fixed
/// focal plane if the renderer does not support one.
HOGEL_API std::unique_ptr<Renderer> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                  const LightFieldGrid& grid);

/// Makes a light field with the four-dimensional depth buffer exactly as in [K] 5.5 to 5.7. The renderer `simplex`
/// shades each ray. This one shades only where the corners of a square region of hogels see the corners of a triangle,
/// and interpolates radiance and depth in four dimensions. Radiance given at vertices is the same up to rounding. Light
/// that depends on the viewer or is evaluated at samples becomes an approximation, coarser for larger regions. Textures
/// are sampled per ray.
///
/// Throws Error(usage) for a region of 0, for directions other than a front perspective, and for a scene not wholly
/// behind the hologram plane.
/// @param region  side of a region, hogels; regions begin at its multiples
HOGEL_API std::unique_ptr<Renderer> make_interpolating_renderer(std::shared_ptr<const ShadedScene> scene,
                                                                const LightFieldGrid& grid, std::size_t region);

/// Supersampling factors along each side of a hogel and of the cell around a direction. A ray has hogel² · direction²
/// samples on a regular grid.
struct SamplesPerRay {
    std::size_t hogel = 1;      ///< along a side of a hogel
    std::size_t direction = 1;  ///< along a side of a direction's cell

    /// Returns the number of samples per ray.
    std::size_t count() const { return hogel * hogel * direction * direction; }
};

/// Returns the grid that divides the cells of `grid` by these factors. Throws Error(usage) for factors outside 1 to 64,
/// and for too many samples to address.
HOGEL_API LightFieldGrid finer(const LightFieldGrid& grid, const SamplesPerRay& samples);

/// Box-filters a light field: each value is the mean over the samples of `fine` in its cell in s, t, U and V. The depth
/// of a ray is the smallest in its cell: a mean may lie where there is no surface, and objects in front keep their
/// outline. Memory per tile: the preferred tile of `fine`, or all samples of one hogel. Throws Error(usage) unless
/// `fine` has the grid finer(grid, samples).
HOGEL_API std::unique_ptr<LightFieldSource> average(std::shared_ptr<const LightFieldSource> fine,
                                                    const LightFieldGrid& grid, const SamplesPerRay& samples);

/// Makes a light field as make_renderer() above, with several samples per ray (see average()).
HOGEL_API std::unique_ptr<Renderer> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                  const LightFieldGrid& grid, const SamplesPerRay& samples);

}  // namespace hogel
