// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numbers>

#include "bench/render/render.h"
#include "hogel/error.h"
#include "hogel/renderer.h"
#include "hogel/scene/tessellate.h"

namespace hogel::bench {
namespace {

struct ThesisScene {
    const char *name, *shading, *note;
    double faster;  // speed of the best 4D renderer relative to 2D in [K]; 0 if not given
};
// Scenes of [K] fig. 5.26 to 5.30, shaded as in [K]. The notes quote its text on the curves, which gives no numbers.
constexpr std::array thesis_scenes{
    ThesisScene{"church", "direct",
                "[K] fig. 5.26, one 120 MHz processor, axis to 40 s: \"only a marginal improvement\"", 0},
    ThesisScene{"church-radiance", "given",
                "[K] fig. 5.27, one 120 MHz processor, axis to 600 s: \"over 20:1\", still falling where memory ends",
                20},
    ThesisScene{"chandelier", "direct",
                "[K] fig. 5.28, one 120 MHz processor, axis to 30 s: gain between those of fig. 5.26 and 5.27", 0},
    ThesisScene{"billiards", "shadowed",
                "[K] fig. 5.29, one 120 MHz processor, axis to 20 s: gain between those of fig. 5.26 and 5.27", 0},
    ThesisScene{"pumpkin", "vertex",
                "[K] fig. 5.30, one 120 MHz processor, axis to 6 s: gain between those of fig. 5.26 and 5.27", 0}};

const ThesisScene* thesis_scene(const std::string& name) {
    const auto* const found = std::ranges::find(thesis_scenes, name, &ThesisScene::name);
    return found != thesis_scenes.end() ? found : nullptr;
}

// Moves a scene behind the hologram, at a distance of `gap`.
Scene behind(Scene scene, double gap) {
    const double back = bounds(scene).high.z + gap;
    for (Mesh& mesh : scene.meshes)
        for (Vec3& position : mesh.positions) position.z -= back;
    for (Light& light : scene.lights) light.position.z -= back;
    return scene;
}

// The first two lines of a table.
std::string table_head(std::size_t max_side, bool ratios) {
    std::string head = "| |", line = "|---|";
    for (std::size_t side = 1; side <= max_side; side *= 2) {
        head += fmt::format(" {} |", side);
        line += "---|";
    }
    return head + (ratios ? " times `zbuffer` |" : "") + " memory |\n" + line + (ratios ? "---|" : "") + "---|\n";
}

// A renderer's row of a table.
// @param reference  the renderer with which the others are compared, or null
std::string table_row(const RegionTimes& times, const RegionTimes* reference, std::size_t max_side) {
    const auto& points = times.curve.points;
    std::string row = fmt::format("| `{}` |", times.curve.name);
    std::size_t i = 0;
    for (std::size_t side = 1; side <= max_side; side *= 2, ++i)
        row += i < points.size() ? fmt::format(" {}{:.3g} |", times.part > 1 ? "≈ " : "", points[i].second) : " |";
    if (reference)
        row += points.empty() ? " |"
                              : fmt::format(" {:.3g} |", reference->curve.points.front().second / points.back().second);
    return row + fmt::format(" {} |\n", format_bytes(times.bytes));
}

// Returns the lines below the axis of a plot.
std::vector<std::string> notes(const std::string& scene, const std::vector<RegionTimes>& all) {
    std::vector<std::string> lines;
    std::string parts;
    for (const RegionTimes& times : all)
        if (times.part > 1) parts += fmt::format("{}{} 1/{}", parts.empty() ? "" : ", ", times.curve.name, times.part);
    if (!parts.empty()) lines.push_back("dashed: measured on a part of the triangles: " + parts);
    if (const ThesisScene* thesis = thesis_scene(scene)) lines.emplace_back(thesis->note);
    return lines;
}

// Returns a scene's name, and the number of parts into which the sides of its triangles are cut.
std::pair<std::string, std::size_t> named_scene(const std::string& name) {
    const std::size_t colon = name.rfind(':');
    if (colon == std::string::npos || colon + 1 == name.size() ||
        name.find_first_not_of("0123456789", colon + 1) != std::string::npos)
        return {name, 1};
    return {name.substr(0, colon), parse_count(name.substr(colon + 1), name)};
}

// Plots the measured times.
void plot(const std::string& name, const std::string& title, const std::string& subtitle,
          const std::vector<RegionTimes>& all, const RenderOptions& options) {
    PlotText text{title, subtitle, "Side of the region (hogels)", "Time for each hogel (ms)"};
    text.notes = notes(name, all);
    std::vector<Curve> curves;
    for (const RegionTimes& times : all) curves.push_back(times.curve);
    const auto reference = std::ranges::find(curves, "zbuffer", &Curve::name);
    if (const ThesisScene* thesis = thesis_scene(name); thesis && thesis->faster > 0 && reference != curves.end())
        text.levels.emplace_back(fmt::format("{:g}:1, [K]", thesis->faster),
                                 reference->points.front().second / thesis->faster);
    options.write_plot("render", name, text, curves);
}

// Prints and plots each renderer as soon as it is measured, so that an interrupted run keeps its results.
void measure_scene(const std::string& name, std::vector<std::string> algorithms, const RenderOptions& options,
                   const Session& session) {
    LightFieldOptions light_field = options.light_field(render_defaults.hogels, render_defaults.directions);
    light_field.shading = options.shading_of(name);
    light_field.cache_spacing = options.cache_spacing.value_or(0);  // as in [K]
    const LightFieldGrid grid = light_field.grid();
    const RegionLimits limits{options.max_side.value_or(128), options.seconds.value_or(render_defaults.seconds),
                              1e9 * options.gigabytes};
    // The reference for the others.
    const auto zbuffer = std::ranges::find(algorithms, "zbuffer");
    const bool ratios = zbuffer != algorithms.end();
    if (ratios) std::rotate(algorithms.begin(), zbuffer, zbuffer + 1);
    const auto scene = bench_scene(session, name, light_field);
    const std::string title =
        fmt::format("{}, {} triangles, shading '{}'", name, scene->triangles.size(), light_field.shading);
    const std::string subtitle = fmt::format(
        "{}x{} directions over {:.4g} degrees, hogels {} apart; one core", grid.directions_u, grid.directions_v,
        light_field.field_of_view.across * 180 / std::numbers::pi, format_length(grid.pitch));
    fmt::print("{}; {}.\nMilliseconds a hogel against the side of the region in hogels.\n\n{}", title, subtitle,
               table_head(limits.side, ratios));
    std::vector<RegionTimes> all;
    for (const std::string& algorithm : algorithms) {
        std::fflush(stdout);
        stop_if_interrupted();
        session.detail(fmt::format("{}: {}", name, algorithm));
        all.push_back(time_regions(algorithm, scene, grid, limits));
        fmt::print("{}", table_row(all.back(), ratios ? &all.front() : nullptr, limits.side));
        session.detail(fmt::format("{} hogels a side at most, {}", 1 << (all.back().curve.points.size() - 1),
                                   format_bytes(all.back().bytes)));
        plot(name, title, subtitle, all, options);
    }
    fmt::print("\n");
    std::fflush(stdout);
}

}  // namespace

std::vector<std::string> thesis_scene_names() {
    std::vector<std::string> names;
    for (const ThesisScene& scene : thesis_scenes) names.emplace_back(scene.name);
    return names;
}

LightFieldOptions RenderOptions::light_field(std::size_t default_hogels, std::size_t default_directions) const {
    LightFieldOptions light_field;
    light_field.hogels = hogels.value_or(Counts{default_hogels, default_hogels});
    light_field.directions = directions.value_or(Counts{default_directions, default_directions});
    light_field.cache_spacing = cache_spacing.value_or(default_cache_spacing);
    light_field.size = size;
    light_field.field_of_view = field_of_view;
    return light_field;
}

std::string RenderOptions::shading_of(const std::string& scene) const {
    if (!shading.empty()) return shading;
    const ThesisScene* thesis = thesis_scene(named_scene(scene).first);
    return thesis ? thesis->shading : default_shading;
}

void RenderOptions::prepare_output() const {
    if (!output.empty()) create_folder(output);
}

void RenderOptions::write_plot(const std::string& kind, const std::string& scene, const PlotText& text,
                               const std::vector<Curve>& curves) const {
    if (output.empty()) return;
    const std::string name = std::filesystem::path(scene).stem().string();
    write_text(std::filesystem::path(output) / fmt::format("{}_{}.svg", kind, name), plot_svg(text, curves));
}

std::shared_ptr<const ShadedScene> bench_scene(const Session& session, const std::string& name,
                                               const LightFieldOptions& options) {
    const auto [plain, parts] = named_scene(name);
    Scene scene = behind(load_scene(plain, options), 0.05 * options.size);
    if (parts != 1) scene = scene::tessellate(scene, parts);
    return shade(session, scene, options);
}

void measure_regions(const RenderOptions& options, const Session& session) {
    std::vector<std::string> scenes = options.scenes, algorithms = options.algorithms;
    if (scenes.empty()) scenes = thesis_scene_names();
    if (algorithms.empty())
        for (const RendererInfo& info : renderers().rows()) algorithms.emplace_back(info.name);
    // Fails for unknown names before the first measurement.
    const LightFieldGrid grid = options.light_field(render_defaults.hogels, render_defaults.directions).grid();
    for (const std::string& algorithm : algorithms) make_renderer(algorithm, std::make_shared<ShadedScene>(), grid);
    options.prepare_output();
    for (const std::string& name : scenes) measure_scene(name, algorithms, options, session);
}

}  // namespace hogel::bench
