#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "bench_render.h"
#include "commands.h"
#include "hogel/render/renderer.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string output, shading;
    std::vector<std::string> scenes, algorithms;
    RenderOptions render;
    RegionLimits limits{defaults.bench_largest_region, defaults.bench_seconds, 1e9 * defaults.bench_gigabytes};
    double gigabytes = defaults.bench_gigabytes;
};

struct ThesisScene {
    const char *name, *shading;
};
// The scenes of [K] fig. 5.26 to 5.30, shaded as there.
constexpr std::array thesis_scenes{ThesisScene{"church", "direct"}, ThesisScene{"church-radiance", "given"},
                                   ThesisScene{"chandelier", "direct"}, ThesisScene{"billiards", "shadowed"},
                                   ThesisScene{"pumpkin", "vertex"}};

std::string shading_of(const std::string& scene, const Options& options) {
    if (!options.shading.empty()) return options.shading;
    const auto* const known = std::ranges::find(thesis_scenes, scene, &ThesisScene::name);
    return known != thesis_scenes.end() ? known->shading : std::string(defaults.shading);
}

// Pushed behind the hologram, where every renderer can see it.
Scene behind(Scene scene, double gap) {
    const double back = bounds(scene).high.z + gap;
    for (Mesh& mesh : scene.meshes)
        for (Vec3& position : mesh.positions) position.z -= back;
    for (Light& light : scene.lights) light.position.z -= back;
    return scene;
}

std::string table(const std::vector<Curve>& curves, std::size_t largest) {
    std::string head = "| |", line = "|---|", rows;
    for (std::size_t side = 1; side <= largest; side *= 2) {
        head += fmt::format(" {} |", side);
        line += "---|";
    }
    const auto reference = std::ranges::find(curves, "zbuffer", &Curve::name);
    for (const Curve& curve : curves) {
        rows += fmt::format("| `{}` |", curve.name);
        std::size_t i = 0;
        for (std::size_t side = 1; side <= largest; side *= 2, ++i)
            rows += i < curve.points.size() ? fmt::format(" {:.3g} |", curve.points[i].second) : " |";
        if (reference != curves.end() && !curve.points.empty())
            rows += fmt::format(" {:.3g} |", reference->points.front().second / curve.points.back().second);
        rows += "\n";
    }
    if (reference != curves.end()) {
        head += " times `zbuffer` |";
        line += "---|";
    }
    return head + "\n" + line + "\n" + rows;
}

int bench(const Options& options, const Session& session) {
    std::vector<std::string> scenes = options.scenes, algorithms = options.algorithms;
    if (scenes.empty())
        for (const ThesisScene& scene : thesis_scenes) scenes.emplace_back(scene.name);
    if (algorithms.empty())
        for (const RendererInfo& info : renderers()) algorithms.emplace_back(info.name);
    const LightFieldGrid grid = options.render.grid();
    for (const std::string& algorithm : algorithms) make_renderer(algorithm, std::make_shared<ShadedScene>(), grid);
    for (const std::string& scene : scenes)
        if (input_kind(scene) != InputKind::scene)
            throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", scene));
    RegionLimits limits = options.limits;
    limits.bytes = 1e9 * options.gigabytes;

    std::optional<OutputFolder> folder;
    if (!options.output.empty()) folder.emplace(options.output);
    for (const std::string& name : scenes) {
        RenderOptions render = options.render;
        render.shading = shading_of(name, options);
        render.light_spacing = 0;  // or who came first would pay for the light of all
        const auto scene = lit(session, behind(load_scene(session, name, render), 0.05 * render.size), render);
        const std::string title =
            fmt::format("{}, {} triangles, shading '{}'", name, scene->triangles.size(), render.shading);
        const std::string subtitle = fmt::format(
            "{}x{} directions over {:.4g} degrees, hogels {} apart; one core", grid.directions_u, grid.directions_v,
            render.field_of_view.across * 180 / std::numbers::pi, format_length(grid.pitch));
        std::vector<Curve> curves;
        for (const std::string& algorithm : algorithms) {
            if (interrupted_by() != 0) throw Error(ErrorCode::cancelled, "stopped");
            session.detail(fmt::format("{}: {}", name, algorithm));
            curves.push_back(time_regions(algorithm, scene, grid, limits));
            if (curves.back().points.empty())
                session.say(fmt::format("{}: '{}' would take too long (see --seconds)", name, algorithm));
        }
        fmt::print("{}; {}.\nMilliseconds a hogel against the side of the region in hogels.\n\n{}\n", title, subtitle,
                   table(curves, limits.side));
        if (folder && std::ranges::any_of(curves, [](const Curve& curve) { return !curve.points.empty(); }))
            write_text(folder->path() / fmt::format("render_{}.svg", std::filesystem::path(name).stem().string()),
                       plot_svg({title, subtitle, "Side of the region (hogels)", "Time for each hogel (ms)",
                                 PlotText::Scale::logarithmic},
                                curves));
    }
    return 0;
}

}  // namespace

void add_bench_render(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    options->render.hogels = {defaults.bench_hogels, defaults.bench_hogels};
    options->render.directions = {defaults.bench_directions, defaults.bench_directions};
    options->render.field_of_view = {defaults.bench_field_of_view, defaults.bench_field_of_view};
    CLI::App* command =
        add_command(app, session, "render", "Measure renderers: time per hogel against the size of the region",
                    "  hogel bench render -o plots\n"
                    "  hogel bench render --scenes pumpkin --algorithms zbuffer,simplex,epi --largest 32",
                    [options, &session] { return bench(*options, session); });
    command->add_option("-o,--output", options->output, "Folder for a plot of each scene, SVG")->type_name("DIR");
    command->add_option("--scenes", options->scenes, "Scenes; those of the thesis if none are named")
        ->type_name("SCENE,...")
        ->delimiter(',');
    command->add_option("--algorithms", options->algorithms, "Renderers; all if none are named")
        ->type_name("NAME,...")
        ->delimiter(',');
    command->add_option("--shading", options->shading, "Model of shading; if none is named, that of the thesis")
        ->type_name("NAME");
    add_count(command, "--largest", options->limits.side, "Largest side of a region, in hogels");
    command->add_option("--seconds", options->limits.seconds, "Enlarge a region no more that would take longer")
        ->type_name("S")
        ->check(CLI::Range(1e-3, 1e6).description(""))
        ->capture_default_str();
    command
        ->add_option("--memory", options->gigabytes, "Enlarge a region no more that would take more, at 20 bytes a ray")
        ->type_name("GB")
        ->check(CLI::Range(1e-3, 1e6).description(""))
        ->capture_default_str();
    add_counts(command, "--hogels", options->render.hogels, "Hogels across and down");
    add_counts(command, "--directions", options->render.directions, "Directions across and down in each hogel");
    add_length(command, "--size", options->render.size, "Width of the hologram");
    add_angles(command, "--fov", options->render.field_of_view, "Field of view, the full angle; or across and down");
}

}  // namespace hogel::cli
