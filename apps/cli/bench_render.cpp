// SPDX-License-Identifier: Apache-2.0
#include "bench_render.h"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "hogel/renderer.h"
#include "resources.h"

namespace hogel::cli {
namespace {

// A tile is rendered by the thread that asks for it.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// @param lit  whether light is kept on surfaces: then it is worked out before
double time_of_reading(const LightFieldSource& source, LightFieldTile& tile, bool lit) {
    if (lit) source.read(tile);
    const double began = thread_seconds();
    source.read(tile);
    return thread_seconds() - began;
}

// Seconds a hogel, of hogels spread evenly over the hologram.
double time_of_hogels(const LightFieldSource& source, double budget, bool lit) {
    const LightFieldGrid& grid = source.grid();
    constexpr std::size_t least = 3, most = 64;
    double seconds = 0;
    std::size_t hogels = 0;
    while (hogels < least || (seconds < budget && hogels < most)) {
        // The multiples of the inverse powers of the plastic number fill a square evenly.
        constexpr double plastic = 1.32471795724474602596;
        const auto place = [&](double step, std::size_t n) {
            const double part = 0.5 + static_cast<double>(hogels) * step;
            return std::min(n - 1, static_cast<std::size_t>((part - std::floor(part)) * static_cast<double>(n)));
        };
        const HogelRange hogel{place(1 / plastic, grid.hogels_s), place(1 / (plastic * plastic), grid.hogels_t), 1, 1};
        LightFieldTile tile(grid, hogel, false);
        seconds += time_of_reading(source, tile, lit);
        ++hogels;
    }
    return seconds / static_cast<double>(hogels);
}

// Every part-th run of triangles that follow each other, as these share vertices and look alike; or none for part 0.
std::shared_ptr<const ShadedScene> thinned(const ShadedScene& scene, std::size_t part) {
    auto few = std::make_shared<ShadedScene>(scene);
    few->triangles.clear();
    few->radiance_cache = nullptr;  // knows triangles by their numbers
    constexpr std::size_t run = 16;
    for (std::size_t i = 0; part > 0 && i < scene.triangles.size(); ++i)
        if (i / run % part == 0) few->triangles.push_back(scene.triangles[i]);
    return few;
}

// The least part by which a single hogel takes no longer than it may: a power of two, 1 as a rule.
std::size_t affordable_part(const std::string& algorithm, const ShadedScene& scene, const LightFieldGrid& grid,
                            double seconds) {
    constexpr std::size_t guess = 64;
    const auto source = make_renderer(algorithm, thinned(scene, guess), grid);
    LightFieldTile tile(grid, {grid.hogels_s / 2, grid.hogels_t / 2, 1, 1}, false);
    const double whole = guess * time_of_reading(*source, tile, false);
    std::size_t part = 1;
    while (whole > seconds * static_cast<double>(part)) part *= 2;
    return part;
}

}  // namespace

RegionTimes time_regions(const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene,
                         const LightFieldGrid& grid, const RegionLimits& limits) {
    const double before = forget_most_memory();
    const bool lit = scene->radiance_cache != nullptr;
    const bool hogel_by_hogel = algorithm == "raytrace" || algorithm == "zbuffer";
    const bool row_by_row = algorithm == "simplex3d" || algorithm == "mvr";
    const std::size_t largest = std::min({limits.side, grid.hogels_s, grid.hogels_t});
    RegionTimes times{{algorithm, {}}};
    if (hogel_by_hogel) {
        const auto source = make_renderer(algorithm, scene, grid);
        const double milliseconds = 1e3 * time_of_hogels(*source, 0.2 * limits.seconds, lit);
        for (std::size_t side = 1; side <= largest; side *= 2)
            times.curve.points.emplace_back(static_cast<double>(side), milliseconds);
        times.bytes = max_memory_held() - before;
        return times;
    }
    times.part = affordable_part(algorithm, *scene, grid, limits.seconds);
    times.curve.dashed = times.part > 1;
    const auto source = make_renderer(algorithm, times.part > 1 ? thinned(*scene, times.part) : scene, grid);
    const auto empty = make_renderer(algorithm, thinned(*scene, 0), grid);
    double last = 0;
    for (std::size_t side = 1; side <= largest; side *= 2) {
        const std::size_t rows = row_by_row ? 1 : side, hogels = side * rows;
        constexpr double bytes_per_ray = 20, min_growth = 1.5;
        const double bytes = static_cast<double>(hogels * grid.directions()) * bytes_per_ray;
        if (bytes > limits.bytes || last * min_growth > limits.seconds) break;
        LightFieldTile tile(grid, {(grid.hogels_s - side) / 2, (grid.hogels_t - rows) / 2, side, rows}, false);
        last = time_of_reading(*source, tile, lit && times.part == 1);
        // Short times are uncertain, and the first includes memory that is touched for the first time.
        if (last < 0.02 * limits.seconds) last = std::min(last, time_of_reading(*source, tile, false));
        const auto part = static_cast<double>(times.part);
        const double whole = times.part > 1 ? part * last - (part - 1) * time_of_reading(*empty, tile, false) : last;
        times.curve.points.emplace_back(static_cast<double>(side), 1e3 * whole / static_cast<double>(hogels));
    }
    times.bytes = max_memory_held() - before;
    return times;
}

}  // namespace hogel::cli
