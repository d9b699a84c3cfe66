// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "hogel/light_field.h"
#include "hogel/shading.h"
namespace hogel {

struct RendererInfo {
    std::string_view name;
    std::string_view description;  ///< one line
    bool crosses_plane = true;     ///< whether it renders scenes that are not wholly behind the hologram plane
};

/// The renderers that make_renderer knows.
std::span<const RendererInfo> renderers();

/// A light field that is rendered where it is read, by the algorithm of that name. Offers depth per ray. The scene is
/// shared, never copied. Throws Error(usage) for an unknown name, listing the known ones, and for
/// a scene that is not wholly behind the hologram plane where the renderer does not straddle.
std::unique_ptr<LightFieldSource> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                const LightFieldGrid& grid);

/// So many samples along each side of a hogel, and along each side of the cell around a direction: hogel² · direction²
/// for each ray, on a regular grid.
struct SamplesPerRay {
    std::size_t hogel = 1, direction = 1;

    std::size_t count() const { return hogel * hogel * direction * direction; }
};

/// The sampling whose cells divide those of `grid`. Throws Error(usage) where that is too fine.
LightFieldGrid finer(const LightFieldGrid& grid, const SamplesPerRay& samples);

/// A light field filtered by a box as wide as a sample's cell in s, t, U and V: each value is the mean of those of
/// `fine`, which has the grid `finer(grid, samples)`. The depth of a ray is the nearest in its cell: it belongs to
/// something that the ray shows, which a mean need not, and what is in front has its outline. Memory of a tile: `fine`
/// in the tile that suits it, or all samples of one hogel.
std::unique_ptr<LightFieldSource> average(std::unique_ptr<LightFieldSource> fine, const LightFieldGrid& grid,
                                          const SamplesPerRay& samples);

/// As make_renderer (render/renderer.h), but with several samples a ray.
std::unique_ptr<LightFieldSource> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                const LightFieldGrid& grid, const SamplesPerRay& samples);

/// What a renderer allocates to render a region of hogels at once, besides the tile that takes its values: the depth
/// buffer of `simplex`, `simploid`, `simplex3d` and `oblique`, in bytes. Nothing for those whose memory does not
/// grow with the region.
double depth_buffer_bytes(std::string_view algorithm, const LightFieldGrid& grid, const HogelRange& region);

}  // namespace hogel
