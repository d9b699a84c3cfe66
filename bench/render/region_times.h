// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/plot.h"
#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::bench {

/// Limits for enlarging regions.
struct RegionLimits {
    std::size_t side = 0;  ///< side of the largest region, in hogels
    double seconds = 0;    ///< maximum expected time of a region
    double bytes = 0;      ///< maximum memory of a region, 20 per ray: three values and a depth buffer
    /// Whether a region beyond these limits is rendered in slabs of its directions, each with its own depth buffer: all
    /// slabs beyond the memory limit, the affordable number, evenly spread over V, beyond the time limit. A triangle is
    /// set up again for each slab that may show it, so the time is an upper bound.
    bool slabs = false;
};

/// Times of a renderer, and conditions of the measurement.
struct RegionTimes {
    Curve curve;                     ///< x: side of the region in hogels; y: milliseconds per hogel
    double bytes = 0;                ///< maximum memory without the scene
    std::size_t part = 1;            ///< n if one in n triangles was rendered
    std::vector<double> directions;  ///< rendered fraction of the directions, for each point
    /// Last slices, and tests of a ray against a triangle, per ray of the largest region; 0 if not counted.
    double slices_a_ray = 0, tests_a_ray = 0;
};

/// Name of make_interpolating_renderer() with the measured region, for time_regions().
inline constexpr const char* interpolated_simplex = "simplex, interpolated";

/// Measures milliseconds of one core per hogel of a light field, including shading, against the side of the region that
/// is rendered at once. The regions are
///   - squares of 1, 2, 4 … hogels in or near the middle of the hologram, for most renderers;
///   - rows of 1, 2, 4 … hogels, for `simplex3d` and `mvr`, which render each row separately;
///   - single hogels all over the hologram, for `raytrace` and `zbuffer`; the result is their mean.
/// Times are processor time, so that other work on the machine has little influence. If the scene has a radiance cache,
/// a first, unmeasured reading fills it.
///
/// If a single hogel would exceed the limit, one in n triangles is rendered, without a cache, and the time in excess of
/// that of an empty scene is multiplied by n. This is correct for renderers with work proportional to the triangles,
/// which includes all slow ones. The curve is then dashed.
/// @param measured  called after each measured point, which is the last of the curve
RegionTimes time_regions(
    const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene, const LightFieldGrid& grid,
    const RegionLimits& limits, const std::function<void(const RegionTimes&)>& measured = [](const RegionTimes&) {});

}  // namespace hogel::bench
