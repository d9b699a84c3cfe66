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
    /// Replaces the scene, by another one or by the same object with new contents. The light field is bit for bit that
    /// of a new renderer; memory of the last scene is reused where it suffices. No other thread may read during the
    /// call, and tiles cached by a cached_tiles() around the renderer are out of date afterwards. Throws what
    /// make_renderer() throws; after an exception the renderer must not be read until another scene has been set.
    virtual void set_scene(std::shared_ptr<const ShadedScene> scene) = 0;
};

/// What rendering a region of hogels at once takes.
struct RenderCost {
    double bytes = 0;             ///< beside the tile that receives the values, such as depth buffers
    double bytes_a_triangle = 0;  ///< for each triangle of the scene; all regions that are in progress share them
    double rays = 0;              ///< processor time beside that of its rays, in rays of `epi` and a small scene
};

/// A rendering algorithm.
struct RendererInfo {
    std::string name;  ///< by which make_renderer() finds it
    std::string text;  ///< one line
    /// Makes a light field of the scene, which is shared, never copied. If the source is a Renderer, its set_scene()
    /// receives later scenes; any other source is replaced by a new one for each scene. Throws Error(usage) for a scene
    /// that the algorithm cannot render.
    std::function<std::unique_ptr<LightFieldSource>(std::shared_ptr<const ShadedScene> scene,
                                                    const LightFieldGrid& grid)>
        make;
    bool crosses_plane = true;  ///< can render scenes that are not wholly behind the hologram plane
    double time_of_a_ray = 10;  ///< an estimate of the processor time, in that of a ray of `epi`
    /// What a region takes; null: RenderCost().
    std::function<RenderCost(const LightFieldGrid& grid, const HogelRange& region, std::size_t triangles)> cost =
        nullptr;
    bool casts_rays = false;         ///< needs Embree; in a build without it make() throws Error(not_built_in)
    bool takes_frequencies = false;  ///< can render light fields whose directions are uniform in sines
    /// Can render light fields with a fixed focal plane, wherever the scene is. Other renderers are given the
    /// projection of a scene that does not reach the plane (docs/renderers.md).
    bool takes_focal_plane = false;
};

/// The renderers by name.
HOGEL_API Table<RendererInfo>& renderers();

/// Makes a light field of the scene with the renderer of that name. It has depth. The scene is shared, never copied.
/// Throws Error(usage) for an unknown name, for a grid uniform in sines if the renderer takes only perspectives, for a
/// scene that is not wholly behind the hologram plane if the renderer cannot cross it, and for one that reaches a fixed
/// focal plane if the renderer takes none itself.
HOGEL_API std::unique_ptr<Renderer> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                  const LightFieldGrid& grid);

/// The four-dimensional depth buffer of [K] 5.5 to 5.7 to the letter. Where the renderer `simplex` computes what a ray
/// sees from the ray and the triangle, this one computes shading where the corners of a square region of hogels see the
/// corners of a triangle, and interpolates it, with depth, in four dimensions. Radiance that is given at vertices is
/// the same to rounding; what depends on the viewer, or on light that is evaluated at samples, is an approximation that
/// is the coarser the larger the region. Textures are looked up at each sample.
/// @param region  side of a region, in hogels; regions begin at multiples of it
/// Throws Error(usage) for a region of 0, for directions that are not a perspective's front, and for a scene that is
/// not wholly behind the hologram plane.
HOGEL_API std::unique_ptr<Renderer> make_interpolating_renderer(std::shared_ptr<const ShadedScene> scene,
                                                                const LightFieldGrid& grid, std::size_t region);

/// Supersampling factors along each side of a hogel and along each side of the cell around a direction. Together they
/// make hogel² · direction² samples per ray, on a regular grid.
struct SamplesPerRay {
    std::size_t hogel = 1;      ///< along a hogel's side
    std::size_t direction = 1;  ///< along a side of a direction's cell

    /// Samples per ray.
    std::size_t count() const { return hogel * hogel * direction * direction; }
};

/// The grid whose cells divide those of `grid` by these factors. Throws Error(usage) for factors outside 1 to 64, and
/// for more samples than can be addressed.
HOGEL_API LightFieldGrid finer(const LightFieldGrid& grid, const SamplesPerRay& samples);

/// Box-filters a light field: each value is the mean over the samples of `fine` in its cell in s, t, U and V; `fine`
/// must have the grid `finer(grid, samples)`. The depth of a ray is the smallest in its cell, because a mean may lie
/// where there is no surface; objects in front keep their outline. Memory for a tile: the preferred tile of `fine`, or
/// all samples of one hogel. Throws Error(usage) if `fine` has another grid.
HOGEL_API std::unique_ptr<LightFieldSource> average(std::shared_ptr<const LightFieldSource> fine,
                                                    const LightFieldGrid& grid, const SamplesPerRay& samples);

/// As make_renderer() above, with several samples per ray (see average()).
HOGEL_API std::unique_ptr<Renderer> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                  const LightFieldGrid& grid, const SamplesPerRay& samples);

}  // namespace hogel
