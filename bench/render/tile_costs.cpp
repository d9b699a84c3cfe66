// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/measure.h"
#include "bench/render/render.h"
#include "hogel/renderer.h"
#include "hogel/resources.h"

namespace hogel::bench {
namespace {

// Measures every tile separately, on one thread.
std::vector<double> costs_of(const LightFieldSource& source, std::size_t across, std::size_t down) {
    const LightFieldGrid& grid = source.grid();
    std::vector<double> costs;
    for (std::size_t j = 0; j < down; ++j)
        for (std::size_t i = 0; i < across; ++i) {
            stop_if_interrupted();
            const std::size_t s0 = i * grid.hogels_s / across, s1 = (i + 1) * grid.hogels_s / across;
            const std::size_t t0 = j * grid.hogels_t / down, t1 = (j + 1) * grid.hogels_t / down;
            LightFieldTile tile(grid, {s0, t0, s1 - s0, t1 - t0}, false);
            costs.push_back(median_time_of([&] { source.read(tile); }, 1).processor);
        }
    return costs;
}

}  // namespace

void measure_tiles(const RenderOptions& options, const Session& session) {
    const ThreadLimit single_thread(1);
    const std::size_t across = render_defaults.tiles_across;
    const LightFieldOptions field = options.light_field(4 * across, render_defaults.directions);
    const LightFieldGrid grid = field.grid();
    const std::size_t columns = std::min(across, grid.hogels_s), rows = std::min(across, grid.hogels_t);
    for (const std::string& name : options.scenes) {
        const auto scene = bench_scene(session, name, field);
        const auto source = make_renderer(options.algorithm(), scene, grid);
        const std::vector<double> costs = costs_of(*source, columns, rows);
        const double sum = std::accumulate(costs.begin(), costs.end(), 0.0);
        session.say(fmt::format("{}: {} tiles of {} directions, {:.3g} s in all, {:.3g} to {:.3g} ms each", name,
                                costs.size(), grid.directions(), sum, 1e3 * *std::ranges::min_element(costs),
                                1e3 * *std::ranges::max_element(costs)));
        fmt::print("{} {} {}\n", name, columns, rows);
        for (std::size_t i = 0; i < costs.size(); ++i)
            fmt::print("{}{}", std::lround(1e6 * costs[i]), (i + 1) % 16 == 0 || i + 1 == costs.size() ? "\n" : " ");
    }
}

}  // namespace hogel::bench
