// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "bench/measure.h"
#include "bench/render/render.h"
#include "bench/render/rows.h"
#include "hogel/renderer.h"
#include "hogel/resources.h"
#include "hogel/work/parallel.h"

namespace hogel::bench {
namespace {

// Number of rendered rows of hogels; larger if threads share them, because one row may take twice as long as another.
constexpr std::size_t few_rows = 2, rows_for_threads = 16;

Times times_of(const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene,
               const LightFieldGrid& grid, std::size_t rounds, std::size_t rows = few_rows) {
    const auto source = make_renderer(algorithm, scene, grid);
    HogelRows hogel_rows(*source, rows);
    hogel_rows.render();  // touches the memory
    return median_time_of([&] { hogel_rows.render(); }, rounds);
}

// Returns processor times relative to the first point.
Curve relative(const std::string& name, const std::vector<std::pair<double, double>>& seconds) {
    Curve curve{name, {}};
    for (const auto& [size, time] : seconds) curve.points.emplace_back(size, time / seconds.front().second);
    return curve;
}

std::vector<Curve> measure(const Session& session, const std::string& algorithm, const std::string& name,
                           const std::shared_ptr<const ShadedScene>& scene, LightFieldOptions options,
                           std::size_t rounds) {
    const Counts hogels = options.hogels;
    std::vector<std::pair<double, double>> by_hogels, by_directions, by_triangles;
    for (const std::size_t times : {1, 2, 4, 8}) {
        session.detail(fmt::format("{} times the hogels and the directions", times));
        options.hogels = {times * hogels.columns, times * hogels.rows};
        by_hogels.emplace_back(times, times_of(algorithm, scene, options.grid(), rounds).processor);
        options.hogels = hogels;
        LightFieldGrid grid = options.grid();
        for (std::size_t doubled = 1; doubled < times; doubled *= 2)
            (grid.directions_u > grid.directions_v ? grid.directions_v : grid.directions_u) *= 2;
        by_directions.emplace_back(times, times_of(algorithm, scene, grid, rounds).processor);
    }
    for (const std::size_t parts : {1, 2, 4}) {
        session.detail(fmt::format("{} times the triangles", parts * parts));
        const auto finer = parts == 1 ? scene : bench_scene(session, fmt::format("{}:{}", name, parts), options);
        by_triangles.emplace_back(parts * parts, times_of(algorithm, finer, options.grid(), rounds).processor);
    }
    return {relative("hogels", by_hogels), relative("directions", by_directions), relative("triangles", by_triangles)};
}

std::string table(const std::vector<Curve>& curves) {
    std::string text = "| times as many | 1 | 2 | 4 | 8 | 16 | a doubling, at most |\n|---|---|---|---|---|---|---|\n";
    for (const Curve& curve : curves) {
        text += fmt::format("| {} |", curve.name);
        for (const double times : {1, 2, 4, 8, 16}) {
            const auto point = std::ranges::find(curve.points, times, &std::pair<double, double>::first);
            text += point == curve.points.end() ? " |" : fmt::format(" {:.2f} |", point->second);
        }
        double worst = 0;
        for (std::size_t i = 1; i < curve.points.size(); ++i) {
            const auto [size, time] = curve.points[i - 1];
            const auto [larger, longer] = curve.points[i];
            worst = std::max(worst, std::pow(longer / time, 1 / std::log2(larger / size)));
        }
        text += fmt::format(" {:.2f} |\n", worst);
    }
    return text;
}

// Two triangles that fill the view of every hogel.
std::shared_ptr<const ShadedScene> wall(double size) {
    auto scene = std::make_shared<ShadedScene>();
    for (const auto& [x, y] : {std::pair{-10, -10}, std::pair{10, -10}, std::pair{10, 10}, std::pair{-10, 10}}) {
        scene->positions.push_back({x * size, y * size, -size});
        scene->radiance.push_back({x > 0 ? 1.0f : 0.2f, y > 0 ? 1.0f : 0.2f, 0.5f});
        scene->texture_coordinates.push_back({});
    }
    scene->triangles = {{{0, 1, 2}, ShadedScene::no_texture, 0}, {{0, 2, 3}, ShadedScene::no_texture, 0}};
    return scene;
}

// Prints million samples per second for two triangles that fill the view, and for plain writing of as many samples.
void print_limits(const std::string& algorithm, const LightFieldGrid& grid, double size, std::size_t rounds) {
    const auto source = make_renderer(algorithm, wall(size), grid);
    // Rows of far more memory than the caches.
    constexpr std::size_t min_bytes = std::size_t{1} << 29;
    const std::size_t row_bytes = grid.hogels_s * grid.directions() * grid.channels * sizeof(float);
    HogelRows hogel_rows(*source, std::clamp<std::size_t>(min_bytes / row_bytes, few_rows, grid.hogels_t));
    hogel_rows.render();
    const double rendering = median_time_of([&] { hogel_rows.render(); }, rounds).processor;
    // Some processors write cache lines of zeros without moving data, twice as fast as other values.
    constexpr int not_zero = 0x3f;
    const double writing = median_time_of(
                               [&] {
                                   work::parallel_for(hogel_rows.tiles().size(), [&](std::size_t i) {
                                       const auto values = hogel_rows.tiles()[i].radiance.elements();
                                       std::memset(values.data(), not_zero, values.size_bytes());
                                   });
                               },
                               rounds)
                               .processor;
    fmt::print(
        "Two triangles that fill the view: {:.3g} million samples a processor second; plain writing of the "
        "same samples: {:.3g}; {:.0f} % of its speed.\n",
        1e-6 * hogel_rows.rays() / rendering, 1e-6 * hogel_rows.rays() / writing, 100 * writing / rendering);
}

void print_threads(const std::string& algorithm, const std::shared_ptr<const ShadedScene>& scene,
                   const LightFieldGrid& grid, std::size_t rounds) {
    std::vector<double> seconds;
    const double before = reset_max_memory_held();
    for (const std::size_t threads : {1, 2}) {
        const ThreadLimit limit(threads);
        seconds.push_back(times_of(algorithm, scene, grid, rounds, rows_for_threads).wall);
    }
    fmt::print(
        "Two threads are {:.2f} times as fast as one; at most {} of memory beside the scene's, with {} rows of hogels "
        "that are kept.\n\n",
        seconds[0] / seconds[1], format_bytes(max_memory_held() - before), std::min(rows_for_threads, grid.hogels_t));
}

}  // namespace

void measure_scaling(const RenderOptions& options, const Session& session) {
    const std::vector<std::string> scenes =
        options.scenes.empty() ? std::vector<std::string>{"pumpkin"} : options.scenes;
    const std::string algorithm = options.algorithm();
    options.prepare_output();
    for (const std::string& name : scenes) {
        LightFieldOptions light_field = options.light_field(render_defaults.few_hogels, render_defaults.directions);
        light_field.shading = options.shading_of(name);
        const LightFieldGrid grid = light_field.grid();
        const auto scene = bench_scene(session, name, light_field);
        const std::vector<Curve> curves = measure(session, algorithm, name, scene, light_field, options.rounds);
        const std::string title = fmt::format("What {} takes for larger light fields: {}", algorithm, name);
        const std::string subtitle = fmt::format("from {}x{} hogels of {}x{} directions and the scene as it is",
                                                 grid.hogels_s, grid.hogels_t, grid.directions_u, grid.directions_v);
        fmt::print("{}; {}.\nProcessor time against the first, median of {} rounds.\n\n{}\n", title, subtitle,
                   options.rounds, table(curves));
        std::vector<Curve> drawn = curves;
        Curve& proportional = drawn.emplace_back(Curve{"in proportion", {}});
        for (const double times : {1, 2, 4, 8, 16}) proportional.points.emplace_back(times, times);
        proportional.dashed = true;
        options.write_plot("scaling", name, {title, subtitle, "Times as many", "Times as long"}, drawn);
        print_threads(algorithm, scene, grid, options.rounds);
        print_limits(algorithm, grid, options.size, options.rounds);
    }
}

}  // namespace hogel::bench
