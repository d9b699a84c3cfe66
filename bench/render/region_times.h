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

/// When to stop making regions larger.
struct RegionLimits {
    std::size_t side = 0;  ///< of the largest region, in hogels
    double seconds = 0;    ///< maximum expected time of a region
    double bytes = 0;      ///< maximum of a region, 20 per ray: three values and a depth buffer
    /// Whether a region beyond these limits is rendered in slabs of its directions, one after the other, each with a
    /// depth buffer of its own: all slabs where memory is short, as many as time allows, evenly spread over V, where
    /// that is. A triangle is set up again for each slab that may show it, so the time is an upper bound.
    bool slabs = false;
};

/// The times of a renderer, and how they were measured.
struct RegionTimes {
    Curve curve;                     ///< side of the region, milliseconds for each hogel
    double bytes = 0;                ///< maximum memory without the scene
    std::size_t part = 1;            ///< one in this number of triangles was rendered
    std::vector<double> directions;  ///< for each point, the part of the directions that was rendered
    /// Last slices, and tests of a ray against a triangle, for each ray of the largest region; 0 if not counted.
    double slices_a_ray = 0, tests_a_ray = 0;
};

/// The name by which time_regions() knows make_interpolating_renderer(), with the region that is measured.
inline constexpr const char* interpolated_simplex = "simplex, interpolated";

/// Measures milliseconds of one core per hogel of a light field, including shading, against the side of the region that
/// is rendered at once. The regions are
///   - squares of 1, 2, 4 … hogels in or near the middle of the hologram, for most renderers;
///   - rows of 1, 2, 4 … hogels, for `simplex3d` and `mvr`, which render each row by itself;
///   - single hogels all over the hologram, whose mean is taken, for `raytrace` and `zbuffer`.
/// Times are processor time, so that other work on the machine has little influence. If the scene has a radiance cache,
/// a first reading, which is not measured, fills it.
///
/// If a single hogel would exceed the limit, one in n triangles is rendered, without a cache, and the time in excess of
/// that of an empty scene is multiplied by n. This is right for renderers whose work is a sum over triangles, which
/// includes all slow ones. The curve is then dashed.
/// @param measured  called for each point of the curve, the last in the curve, as soon as it is measured
RegionTimes time_regions(
    const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene, const LightFieldGrid& grid,
    const RegionLimits& limits, const std::function<void(const RegionTimes&)>& measured = [](const RegionTimes&) {});

}  // namespace hogel::bench
