// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "bench/codec/panels.h"
#include "bench/render/render.h"
#include "hogel/renderer.h"
#include "hogel/units.h"

namespace hogel::bench {
namespace {

// Renderer and its name in the figures: those of [K], and the others.
struct Drawn {
    std::string algorithm, name;
};
const std::vector<Drawn> of_thesis{
    {"zbuffer", "2D"}, {"simplex3d", "3D"}, {"simplex", "4D"}, {interpolated_simplex, "4D, interp."}};
const std::vector<Drawn> others{
    {"zbuffer", "zbuffer"}, {"simplex-strips", "strips"}, {"simploid", "simploid"}, {"mvr", "mvr"},
    {"epi", "epi"},         {"raytrace", "raytrace"},     {"oblique", "oblique"}};

const RegionTimes* find(const std::vector<RegionTimes>& all, const std::string& algorithm) {
    const auto found =
        std::ranges::find_if(all, [&](const RegionTimes& times) { return times.curve.name == algorithm; });
    return found == all.end() ? nullptr : &*found;
}

std::vector<Curve> curves_of(const std::vector<RegionTimes>& all, const std::vector<Drawn>& drawn) {
    std::vector<Curve> curves;
    for (const auto& [algorithm, name] : drawn)
        if (const RegionTimes* times = find(all, algorithm)) {
            curves.push_back(times->curve);
            curves.back().name = name;
        }
    return curves;
}

// Returns a round number not below a value: 1, 2, 3, 5 or 8 times a power of ten.
double round_up(double value) {
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 3.0, 5.0, 8.0})
        if (step * power >= value) return step * power;
    return 10 * power;
}

// Makes a panel. Linear axes end at `largest`, rounded up; logarithmic ones contain all points.
Panel panel(const std::string& title, std::vector<Curve> curves, double side, bool logarithmic, double max_y) {
    double low = max_y, high = 0;
    for (const Curve& curve : curves)
        for (const auto& [x, y] : curve.points) {
            low = std::min(low, y);
            high = std::max(high, y);
        }
    PanelAxes axes{"Side of the region (hogels)", "Time for each hogel (ms)", 1, std::max(side, 2.0), 0, 0, 0};
    axes.y_logarithmic = logarithmic;
    if (logarithmic) {
        axes.min_y = std::pow(10, std::floor(std::log10(low)));
        axes.max_y = std::pow(10, std::ceil(std::log10(high)));
    } else {
        axes.max_y = round_up(max_y);
        axes.y_step = axes.max_y / (axes.max_y / std::pow(10, std::floor(std::log10(axes.max_y))) == 8.0 ? 4 : 5);
    }
    return {title, std::move(curves), axes};
}

void draw(const std::string& scene, const std::string& title, const std::string& subtitle, double side,
          const std::vector<RegionTimes>& all, const std::string& folder) {
    const std::vector<Curve> thesis = curves_of(all, of_thesis), rest = curves_of(all, others);
    double reference = 0, largest = 0;
    for (const Curve& curve : thesis)
        for (const auto& [x, y] : curve.points) {
            if (curve.name == "2D") reference = y;
            largest = std::max(largest, y);
        }
    if (reference == 0) reference = largest;
    std::vector<Panel> panels;
    if (!thesis.empty()) {
        panels.push_back(panel("The thesis' algorithms, linear", thesis, side, false, 2 * reference));
        panels.push_back(panel("logarithmic", thesis, side, true, largest));
    }
    if (!rest.empty()) {
        panels.push_back(panel("Other renderers, linear", rest, side, false, 1.25 * reference));
        panels.push_back(panel("logarithmic", rest, side, true, largest));
    }
    write_text(std::filesystem::path(folder) / fmt::format("dense_{}.svg", scene),
               panels_svg(title, subtitle, *panels.front().axes, panels, 2));
}

void measure_scene(const std::string& name, const RenderOptions& options, const Session& session) {
    LightFieldOptions light_field = options.light_field(render_defaults.dense_across, render_defaults.many_directions);
    light_field.shading = options.shading_of(name);
    light_field.cache_spacing = options.cache_spacing.value_or(0);  // as in [K]
    const RegionLimits limits{options.max_side.value_or(render_defaults.dense_side),
                              options.seconds.value_or(render_defaults.dense_seconds), 1e9 * options.gigabytes, true};
    const auto scene = bench_scene(session, name, light_field);
    // The middle of the hologram, large enough for the largest region.
    light_field.across = light_field.hogels.columns;
    light_field.hogels = {limits.side, limits.side};
    const LightFieldGrid grid = light_field.grid();
    const std::string title =
        fmt::format("{}, {} triangles, shading '{}'", name, scene->triangles.size(), light_field.shading);
    const std::string subtitle = fmt::format(
        "{}x{} directions over {:.4g} degrees, hogels {} apart; one core", grid.directions_u, grid.directions_v,
        light_field.field_of_view.across * 180 / std::numbers::pi, format_length(grid.pitch));
    fmt::print(
        "{}; {}.\nMilliseconds of processor time a hogel against the side of the region in hogels; how many "
        "times as fast as the first at its best; what is looked at in the largest region.\n\n| |",
        title, subtitle);
    std::string line = "|---|---|";
    for (std::size_t side = 1; side <= limits.side; side *= 2) {
        fmt::print(" {} |", side);
        line += "---|";
    }
    fmt::print(" times | slices a ray | tests a ray |\n{}---|---|\n", line);
    std::vector<RegionTimes> all;
    std::vector<std::string> names = options.algorithms;
    if (names.empty())
        for (const auto& list : {of_thesis, others})
            for (const Drawn& drawn : list)
                if (std::ranges::count(names, drawn.algorithm) == 0 && drawn.algorithm != "oblique")
                    names.push_back(drawn.algorithm);
    for (const std::string& algorithm : names) {
        std::fflush(stdout);
        stop_if_interrupted();
        session.detail(fmt::format("{}: {}", name, algorithm));
        fmt::print("| `{}` |", algorithm);
        all.push_back(time_regions(algorithm, scene, grid, limits, [](const RegionTimes& times) {
            const bool estimated = times.part > 1 || times.directions.back() < 1;
            fmt::print(" {}{:.3g} |", estimated ? "≈ " : "", times.curve.points.back().second);
            std::fflush(stdout);
        }));
        const auto& points = all.back().curve.points;
        std::size_t i = 0;
        for (std::size_t side = 1; side <= limits.side; side *= 2, ++i)
            if (i >= points.size()) fmt::print(" |");
        const auto best = [](const RegionTimes& times) {
            return std::ranges::min(times.curve.points, {}, &std::pair<double, double>::second).second;
        };
        fmt::print(" {:.3g} |", points.empty() ? 0.0 : best(all.front()) / best(all.back()));
        const RegionTimes& last = all.back();
        fmt::print("{}", last.tests_a_ray > 0 ? fmt::format(" {:.3g} | {:.3g} |\n", last.slices_a_ray, last.tests_a_ray)
                                              : std::string(" | |\n"));
        if (!options.output.empty())
            draw(std::filesystem::path(name).stem().string(), title, subtitle, double(limits.side), all,
                 options.output);
    }
    fmt::print("\n");
    std::fflush(stdout);
}

}  // namespace

void measure_dense(const RenderOptions& options, const Session& session) {
    options.prepare_output();
    for (const std::string& name : options.scenes.empty() ? thesis_scene_names() : options.scenes)
        measure_scene(name, options, session);
}

}  // namespace hogel::bench
