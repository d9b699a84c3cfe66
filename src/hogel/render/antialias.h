#pragma once

#include <memory>
#include <string_view>

#include "hogel/lightfield/light_field.h"
#include "hogel/shading/shaded_scene.h"

namespace hogel {

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

}  // namespace hogel
