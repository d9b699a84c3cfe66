// SPDX-License-Identifier: Apache-2.0
#include "bench/render/region_times.h"

#include <algorithm>
#include <cmath>

#include "bench/measure.h"
#include "bench/session.h"
#include "hogel/core/parallel.h"
#include "hogel/render/layers.h"
#include "hogel/render/visits.h"
#include "hogel/renderer.h"

namespace hogel::bench {
namespace {

// Processor time of reading a tile on the calling thread.
// @param cached  whether the scene has a radiance cache, which a first, unmeasured reading fills
double time_of_reading(const LightFieldSource& source, LightFieldTile& tile, bool cached) {
    const core::StopScope scope(until_interrupted());
    if (cached) source.read(tile);
    const double began = thread_seconds();
    source.read(tile);
    return thread_seconds() - began;
}

std::shared_ptr<const LightFieldSource> make_source(const std::string& algorithm,
                                                    std::shared_ptr<const ShadedScene> scene,
                                                    const LightFieldGrid& grid, std::size_t side) {
    if (algorithm == interpolated_simplex) return make_interpolating_renderer(std::move(scene), grid, side);
    return make_renderer(algorithm, std::move(scene), grid);
}

render::Visits visits_of(const LightFieldSource& source) {
    const auto* counter = dynamic_cast<const render::CountsVisits*>(&render::without_layers(source));
    return counter ? counter->visits() : render::Visits{};
}

// Mean seconds for single hogels, spread evenly over the hologram.
double time_of_hogels(const LightFieldSource& source, double budget, bool cached) {
    const LightFieldGrid& grid = source.grid();
    constexpr std::size_t min_hogels = 3, max_hogels = 64;
    double seconds = 0;
    std::size_t hogels = 0;
    while (hogels < min_hogels || (seconds < budget && hogels < max_hogels)) {
        // The multiples of the inverse powers of the plastic number fill a square evenly.
        constexpr double plastic = 1.32471795724474602596;
        const auto place = [&](double step, std::size_t n) {
            const double part = 0.5 + static_cast<double>(hogels) * step;
            return std::min(n - 1, static_cast<std::size_t>((part - std::floor(part)) * static_cast<double>(n)));
        };
        const HogelRange hogel{place(1 / plastic, grid.hogels_s), place(1 / (plastic * plastic), grid.hogels_t), 1, 1};
        LightFieldTile tile(grid, hogel, false);
        seconds += time_of_reading(source, tile, cached);
        ++hogels;
    }
    return seconds / static_cast<double>(hogels);
}

// One in `part` of the scene's runs of consecutive triangles, which share vertices and are similar; no triangle for
// part 0.
std::shared_ptr<const ShadedScene> thinned(const ShadedScene& scene, std::size_t part) {
    auto few = std::make_shared<ShadedScene>(scene);
    few->triangles.clear();
    few->radiance_cache = nullptr;  // it is indexed by the numbers of triangles
    constexpr std::size_t run = 16;
    for (std::size_t i = 0; part > 0 && i < scene.triangles.size(); ++i)
        if (i / run % part == 0) few->triangles.push_back(scene.triangles[i]);
    return few;
}

// The smallest power of two n, usually 1, for which a hogel with one in n triangles is rendered within `seconds`.
std::size_t affordable_part(const std::string& algorithm, const ShadedScene& scene, const LightFieldGrid& grid,
                            double seconds) {
    constexpr std::size_t guess = 64;
    const auto source = make_source(algorithm, thinned(scene, guess), grid, 1);
    LightFieldTile tile(grid, {grid.hogels_s / 2, grid.hogels_t / 2, 1, 1}, false);
    const double whole = guess * time_of_reading(*source, tile, false);
    std::size_t part = 1;
    while (whole > seconds * static_cast<double>(part)) part *= 2;
    return part;
}

}  // namespace

RegionTimes time_regions(const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene,
                         const LightFieldGrid& grid, const RegionLimits& limits) {
    const double before = reset_max_memory_held();
    const bool cached = scene->radiance_cache != nullptr;
    const bool hogel_by_hogel = algorithm == "raytrace" || algorithm == "zbuffer";
    const bool row_by_row = algorithm == "simplex3d" || algorithm == "mvr";
    const std::size_t max_side = std::min({limits.side, grid.hogels_s, grid.hogels_t});
    RegionTimes times{{algorithm, {}}};
    if (hogel_by_hogel) {
        const auto source = make_renderer(algorithm, scene, grid);
        const double milliseconds = 1e3 * time_of_hogels(*source, 0.2 * limits.seconds, cached);
        for (std::size_t side = 1; side <= max_side; side *= 2)
            times.curve.points.emplace_back(static_cast<double>(side), milliseconds);
        times.bytes = max_memory_held() - before;
        return times;
    }
    times.part = affordable_part(algorithm, *scene, grid, limits.seconds);
    times.curve.dashed = times.part > 1;
    const auto measured = times.part > 1 ? thinned(*scene, times.part) : scene;
    const bool by_region = algorithm == interpolated_simplex;
    auto source = make_source(algorithm, measured, grid, 1);
    const auto empty = make_source(algorithm, thinned(*scene, 0), grid, 1);
    double last = 0;
    for (std::size_t side = 1; side <= max_side; side *= 2) {
        if (by_region) source = make_source(algorithm, measured, grid, side);
        const std::size_t rows = row_by_row ? 1 : side, hogels = side * rows;
        constexpr double bytes_per_ray = 20, min_growth = 1.5;
        const double bytes = static_cast<double>(hogels * grid.directions()) * bytes_per_ray;
        if (bytes > limits.bytes || last * min_growth > limits.seconds) break;
        // Interpolation has regions that begin at multiples of their side.
        const auto middle = [&](std::size_t hogels_there, std::size_t across) {
            return by_region ? hogels_there / 2 / across * across : (hogels_there - across) / 2;
        };
        const HogelRange range{middle(grid.hogels_s, side), middle(grid.hogels_t, rows), side, rows};
        if (range.s0 + side > grid.hogels_s || range.t0 + rows > grid.hogels_t) break;
        LightFieldTile tile(grid, range, false);
        const render::Visits earlier = visits_of(*source);
        last = time_of_reading(*source, tile, cached && times.part == 1);
        const render::Visits now = visits_of(*source);
        const double rays =
            static_cast<double>(hogels * grid.directions()) * (cached && times.part == 1 ? 2 : 1);  // read twice
        times.slices_a_ray = static_cast<double>(now.slices - earlier.slices) / rays;
        times.tests_a_ray = static_cast<double>(now.samples - earlier.samples) / rays;
        // Short times vary, and the first includes that of getting memory from the system.
        if (last < 0.02 * limits.seconds) last = std::min(last, time_of_reading(*source, tile, false));
        const auto part = static_cast<double>(times.part);
        const double whole = times.part > 1 ? part * last - (part - 1) * time_of_reading(*empty, tile, false) : last;
        times.curve.points.emplace_back(static_cast<double>(side), 1e3 * whole / static_cast<double>(hogels));
    }
    times.bytes = max_memory_held() - before;
    return times;
}

}  // namespace hogel::bench
