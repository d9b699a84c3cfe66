// SPDX-License-Identifier: Apache-2.0
#include "bench/render/region_times.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/measure.h"
#include "bench/render/direction_slabs.h"
#include "bench/session.h"
#include "hogel/core/stop_scope.h"
#include "hogel/render/layers.h"
#include "hogel/render/visits.h"
#include "hogel/renderer.h"

namespace hogel::bench {
namespace {

// Returns the processor time in seconds of reading a tile on the calling thread.
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

// Returns the mean seconds for single hogels, spread evenly over the hologram.
double time_of_hogels(const LightFieldSource& source, double budget, bool cached) {
    const LightFieldGrid& grid = source.grid();
    constexpr std::size_t min_hogels = 3, max_hogels = 64;
    double seconds = 0;
    std::size_t hogels = 0;
    while (hogels < min_hogels || (seconds < budget && hogels < max_hogels)) {
        // The multiples of the inverse powers of the plastic number fill a square evenly.
        constexpr double plastic = 1.32471795724474602596;
        const auto position = [&](double step, std::size_t n) {
            const double fraction = 0.5 + static_cast<double>(hogels) * step;
            return std::min(n - 1,
                            static_cast<std::size_t>((fraction - std::floor(fraction)) * static_cast<double>(n)));
        };
        const HogelRange hogel{position(1 / plastic, grid.hogels_s), position(1 / (plastic * plastic), grid.hogels_t),
                               1, 1};
        LightFieldTile tile(grid, hogel, false);
        seconds += time_of_reading(source, tile, cached);
        ++hogels;
    }
    return seconds / static_cast<double>(hogels);
}

// Returns one in `part` of the scene's runs of consecutive, similar triangles; no triangle for part 0.
std::shared_ptr<const ShadedScene> thinned(const ShadedScene& scene, std::size_t part) {
    auto thinned_scene = std::make_shared<ShadedScene>(scene);
    thinned_scene->triangles.clear();
    thinned_scene->radiance_cache = nullptr;  // it is indexed by the numbers of triangles
    constexpr std::size_t run = 16;
    for (std::size_t i = 0; part > 0 && i < scene.triangles.size(); ++i)
        if (i / run % part == 0) thinned_scene->triangles.push_back(scene.triangles[i]);
    return thinned_scene;
}

// Returns the smallest power of two n such that a hogel with 1/n of the triangles is rendered within `seconds`.
std::size_t affordable_part(const std::string& algorithm, const ShadedScene& scene, const LightFieldGrid& grid,
                            double seconds) {
    constexpr std::size_t guess = 64;
    const auto source = make_source(algorithm, thinned(scene, guess), grid, 1);
    LightFieldTile tile(grid, {grid.hogels_s / 2, grid.hogels_t / 2, 1, 1}, false);
    const double all_seconds = guess * time_of_reading(*source, tile, false);
    std::size_t part = 1;
    while (all_seconds > seconds * static_cast<double>(part)) part *= 2;
    return part;
}

struct Rendering {
    std::string algorithm;
    std::shared_ptr<const ShadedScene> scene;
    bool cached = false;  ///< whether the scene has a radiance cache
    std::shared_ptr<const LightFieldSource> full_source =
        nullptr;  ///< source with all directions; null until it is made
};

struct Reading {
    double seconds = 0;  // for all directions
    render::Visits visits;
    double rays = 0;  // number of visited rays
};

std::size_t rows_of(const std::vector<DirectionSlab>& slabs) {
    std::size_t rows = 0;
    for (const DirectionSlab& slab : slabs) rows += slab.rows;
    return rows;
}

// Renders slabs of directions of a square region.
Reading read_slabs(Rendering& rendering, const LightFieldGrid& grid, const HogelRange& range,
                   const std::vector<DirectionSlab>& slabs) {
    Reading reading;
    const bool by_region = rendering.algorithm == interpolated_simplex;
    for (const DirectionSlab& slab : slabs) {
        stop_if_interrupted();
        std::shared_ptr<const LightFieldSource> source;
        const bool all = slab.rows == grid.directions_v;
        if (all && rendering.full_source && !by_region)
            source = rendering.full_source;
        else
            source = make_source(rendering.algorithm, rendering.scene, all ? grid : slab.of(grid), range.ns);
        if (all) rendering.full_source = source;
        LightFieldTile tile(source->grid(), range, false);
        const render::Visits earlier = visits_of(*source);
        reading.seconds += time_of_reading(*source, tile, rendering.cached);
        const render::Visits current = visits_of(*source);
        reading.visits.slices += current.slices - earlier.slices;
        reading.visits.samples += current.samples - earlier.samples;
        reading.rays += static_cast<double>(range.hogels() * source->grid().directions()) *
                        (rendering.cached ? 2 : 1);  // read twice
    }
    reading.seconds *= static_cast<double>(grid.directions_v) / static_cast<double>(rows_of(slabs));
    return reading;
}

// Returns the slabs for rendering a region of this number of hogels; none if it is beyond the limits.
// @param expected  expected time in seconds
std::vector<DirectionSlab> affordable_slabs(const RegionLimits& limits, const LightFieldGrid& grid, std::size_t hogels,
                                            double bytes_per_ray, double expected) {
    const double bytes = static_cast<double>(hogels * grid.directions_u) * bytes_per_ray;  // of one row of directions
    const double max_rows = std::min(std::floor(limits.bytes / bytes), static_cast<double>(grid.directions_v));
    if (!limits.slabs) {
        if (max_rows < static_cast<double>(grid.directions_v) || expected > limits.seconds) return {};
    } else if (max_rows < 1) {
        return {};
    }
    return direction_slabs(grid.directions_v, static_cast<std::size_t>(max_rows),
                           limits.slabs ? limits.seconds / expected : 1);
}

// Returns the region of side × rows hogels in or near the middle; none if it leaves the grid.
// @param aligned  whether the region begins at multiples of its side, as interpolation requires
std::optional<HogelRange> middle(const LightFieldGrid& grid, std::size_t side, std::size_t rows, bool aligned) {
    const auto first = [&](std::size_t hogels, std::size_t across) {
        return aligned ? hogels / 2 / across * across : (hogels - across) / 2;
    };
    const HogelRange range{first(grid.hogels_s, side), first(grid.hogels_t, rows), side, rows};
    if (range.s0 + side > grid.hogels_s || range.t0 + rows > grid.hogels_t) return {};
    return range;
}

}  // namespace

RegionTimes time_regions(const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene,
                         const LightFieldGrid& grid, const RegionLimits& limits,
                         const std::function<void(const RegionTimes&)>& measured) {
    const double initial_bytes = reset_max_memory_held();
    const bool cached = scene->radiance_cache != nullptr;
    const bool hogel_by_hogel = algorithm == "raytrace" || algorithm == "zbuffer";
    const bool row_by_row = algorithm == "simplex3d" || algorithm == "mvr";
    const std::size_t max_side = std::min({limits.side, grid.hogels_s, grid.hogels_t});
    RegionTimes times;
    times.curve.name = algorithm;
    const auto add = [&](std::size_t side, double milliseconds, double directions) {
        times.curve.points.emplace_back(static_cast<double>(side), milliseconds);
        times.directions.push_back(directions);
        times.bytes = max_memory_held() - initial_bytes;
        measured(times);
    };
    if (hogel_by_hogel) {
        const auto source = make_renderer(algorithm, scene, grid);
        const double milliseconds = 1e3 * time_of_hogels(*source, 0.2 * limits.seconds, cached);
        for (std::size_t side = 1; side <= max_side; side *= 2) add(side, milliseconds, 1);
        return times;
    }
    times.part = affordable_part(algorithm, *scene, grid, limits.seconds);
    times.curve.dashed = times.part > 1;
    Rendering rendering{algorithm, times.part > 1 ? thinned(*scene, times.part) : scene, cached && times.part == 1};
    Rendering empty{algorithm, thinned(*scene, 0)};
    const bool aligned = algorithm == interpolated_simplex;
    const double bytes_per_ray = aligned ? 28 : 20;  // colours in its buffer
    double last_seconds = 0;
    for (std::size_t side = 1; side <= max_side; side *= 2) {
        const std::size_t rows = row_by_row ? 1 : side, hogels = side * rows;
        const double min_growth = limits.slabs && !row_by_row ? 4 : 1.5;
        const std::vector<DirectionSlab> slabs =
            affordable_slabs(limits, grid, hogels, bytes_per_ray, last_seconds * min_growth);
        const std::optional<HogelRange> range = middle(grid, side, rows, aligned);
        if (slabs.empty() || !range) break;
        const Reading reading = read_slabs(rendering, grid, *range, slabs);
        last_seconds = reading.seconds;
        times.slices_a_ray = static_cast<double>(reading.visits.slices) / reading.rays;
        times.tests_a_ray = static_cast<double>(reading.visits.samples) / reading.rays;
        // Short times vary, and the first includes the time of memory allocation.
        if (slabs.size() == 1 && last_seconds < 0.02 * limits.seconds)
            last_seconds = std::min(last_seconds, read_slabs(rendering, grid, *range, slabs).seconds);
        const auto triangle_part = static_cast<double>(times.part);
        const double all_seconds =
            times.part > 1
                ? triangle_part * last_seconds - (triangle_part - 1) * read_slabs(empty, grid, *range, slabs).seconds
                : last_seconds;
        add(side, 1e3 * all_seconds / static_cast<double>(hogels),
            static_cast<double>(rows_of(slabs)) / static_cast<double>(grid.directions_v));
    }
    return times;
}

}  // namespace hogel::bench
