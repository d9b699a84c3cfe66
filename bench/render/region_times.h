// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "bench/plot.h"
#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::bench {

/// When to stop making regions larger.
struct RegionLimits {
    std::size_t side = 0;  ///< of the largest region, in hogels
    double seconds = 0;    ///< that a region may be expected to take
    double bytes = 0;      ///< that a region may take, counted as 20 a ray: three values and a depth buffer
};

/// A renderer's times, and how they were measured.
struct RegionTimes {
    Curve curve;           ///< side of the region, milliseconds for each hogel
    double bytes = 0;      ///< the most memory held, beyond the scene
    std::size_t part = 1;  ///< one in so many triangles was rendered
};

/// Milliseconds of one core for each hogel of a light field, shading included, against the side of the region that the
/// renderer is given at once. The regions are
///   - squares of 1, 2, 4 … hogels in the middle of the hologram, for most renderers;
///   - rows of 1, 2, 4 … hogels, for `simplex3d` and `mvr`, which render each row by itself;
///   - single hogels all over the hologram, whose mean is taken, for `raytrace` and `zbuffer`.
/// Times are processor time, so that other work on the machine matters little. Where the scene has a radiance cache, a
/// first reading fills it, which is not counted.
///
/// Where a single hogel would take longer than a region may, one in n triangles is rendered, without a cache, and what
/// that takes beyond an empty scene counts n times. This suits renderers whose work is a sum over triangles, as it is
/// for all that take so long. The curve is dashed then.
RegionTimes time_regions(const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene,
                         const LightFieldGrid& grid, const RegionLimits& limits);

}  // namespace hogel::bench
