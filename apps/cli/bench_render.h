#pragma once

#include <memory>
#include <string>

#include "hogel/lightfield/light_field.h"
#include "hogel/shading/shaded_scene.h"
#include "plot.h"

namespace hogel::cli {

/// How far to go with regions that grow.
struct RegionLimits {
    std::size_t side = 0;  ///< of the largest region, in hogels
    double seconds = 0;    ///< that a region may be expected to take
    double bytes = 0;      ///< that a region may take, counted as 20 a ray: three values and a depth buffer
};

/// Milliseconds of one core for each hogel of a light field, shading included, against the side of the region that the
/// renderer is given at once: squares of 1, 2, 4 … hogels in the middle of the hologram; rows of them for `simplex3d`
/// and `mvr`, which take each row by itself; and for `raytrace` and `zbuffer`, which take each hogel by itself, the
/// mean of hogels all over the hologram. No points where a single hogel would take several times as long as a region
/// may. Measured in processor time, so that other work beside it matters little.
Curve time_regions(const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene,
                   const LightFieldGrid& grid, const RegionLimits& limits);

}  // namespace hogel::cli
