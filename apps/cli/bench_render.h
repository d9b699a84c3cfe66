// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "hogel/light_field.h"
#include "hogel/shading.h"
#include "plot.h"

namespace hogel::cli {

/// How far to go with regions that grow.
struct RegionLimits {
    std::size_t side = 0;  ///< of the largest region, in hogels
    double seconds = 0;    ///< that a region may be expected to take
    double bytes = 0;      ///< that a region may take, counted as 20 a ray: three values and a depth buffer
};

/// A renderer's times, and what they were measured on.
struct RegionTimes {
    Curve curve;
    double bytes = 0;      ///< the most memory held, beyond the scene
    std::size_t part = 1;  ///< times are told from one in so many triangles
};

/// Milliseconds of one core for each hogel of a light field, shading included, against the side of the region that the
/// renderer is given at once: squares of 1, 2, 4 … hogels in the middle of the hologram; rows of them for `simplex3d`
/// and `mvr`, which take each row by itself; and for `raytrace` and `zbuffer`, which take each hogel by itself, the
/// mean of hogels all over the hologram. Measured in processor time, so that other work beside it matters little. Light
/// that is kept on surfaces is worked out by a first reading, which is not counted; but anew where only a part of the
/// triangles is rendered.
///
/// Where a single hogel would take longer than a region may, one in n triangles is rendered instead, and what that
/// takes beyond an empty scene counts n times: good for renderers whose work is a sum over triangles, as that of all
/// is which take so long. Such a curve is dashed.
RegionTimes time_regions(const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene,
                         const LightFieldGrid& grid, const RegionLimits& limits);

}  // namespace hogel::cli
