// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "bench_render_options.h"
#include "commands.h"
#include "hogel/renderer.h"
#include "hogel/scene/tessellate.h"
#include "outputs.h"
#include "render_peers.h"

namespace hogel::cli {
namespace {

struct ThesisScene {
    const char *name, *shading, *note;
    double faster;  // by how much it says that 4D is faster than 2D at best, where it says it
};
// The scenes of [K] fig. 5.26 to 5.30, shaded as there. Its text says this of the curves, and gives no points of them.
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
    const auto* const known = std::ranges::find(thesis_scenes, name, &ThesisScene::name);
    return known != thesis_scenes.end() ? known : nullptr;
}

// Pushed behind the hologram, where every renderer can see it.
Scene behind(Scene scene, double gap) {
    const double back = bounds(scene).high.z + gap;
    for (Mesh& mesh : scene.meshes)
        for (Vec3& position : mesh.positions) position.z -= back;
    for (Light& light : scene.lights) light.position.z -= back;
    return scene;
}

std::string table(const std::vector<RegionTimes>& all, std::size_t largest) {
    std::string head = "| |", line = "|---|", rows;
    for (std::size_t side = 1; side <= largest; side *= 2) {
        head += fmt::format(" {} |", side);
        line += "---|";
    }
    const auto reference = std::ranges::find(all, "zbuffer", [](const RegionTimes& t) { return t.curve.name; });
    const bool ratios = reference != all.end();
    for (const auto& [curve, bytes, part] : all) {
        rows += fmt::format("| `{}` |", curve.name);
        std::size_t i = 0;
        for (std::size_t side = 1; side <= largest; side *= 2, ++i)
            rows += i < curve.points.size() ? fmt::format(" {}{:.3g} |", part > 1 ? "≈ " : "", curve.points[i].second)
                                            : " |";
        if (ratios)
            rows += curve.points.empty()
                        ? " |"
                        : fmt::format(" {:.3g} |", reference->curve.points.front().second / curve.points.back().second);
        rows += fmt::format(" {} |\n", format_bytes(bytes));
    }
    return head + (ratios ? " times `zbuffer` |" : "") + " memory |\n" + line + (ratios ? "---|" : "") + "---|\n" +
           rows;
}

// What the plot says below its axis.
std::vector<std::string> notes(const std::string& scene, const std::vector<RegionTimes>& all) {
    std::vector<std::string> lines;
    std::string parts;
    for (const RegionTimes& times : all)
        if (times.part > 1) parts += fmt::format("{}{} 1/{}", parts.empty() ? "" : ", ", times.curve.name, times.part);
    if (!parts.empty()) lines.push_back("dashed: told from a part of the triangles: " + parts);
    if (const ThesisScene* known = thesis_scene(scene)) lines.emplace_back(known->note);
    return lines;
}

int bench_regions(const BenchRenderOptions& options, const Session& session) {
    std::vector<std::string> scenes = options.scenes, algorithms = options.algorithms;
    if (scenes.empty())
        for (const ThesisScene& scene : thesis_scenes) scenes.emplace_back(scene.name);
    if (algorithms.empty())
        for (const RendererInfo& info : renderers().rows()) algorithms.emplace_back(info.name);
    const LightFieldGrid grid = options.render.grid();
    for (const std::string& algorithm : algorithms) make_renderer(algorithm, std::make_shared<ShadedScene>(), grid);
    RegionLimits limits = options.limits;
    limits.bytes = 1e9 * options.gigabytes;

    std::optional<OutputFolder> folder;
    if (!options.output.empty()) folder.emplace(options.output);
    for (const std::string& name : scenes) {
        RenderOptions render = options.render;
        render.shading = bench_shading(name, options);
        if (!options.own_spacing) render.cache_spacing = 0;  // as in [K]
        const auto scene = bench_scene(session, name, render);
        const std::string title =
            fmt::format("{}, {} triangles, shading '{}'", name, scene->triangles.size(), render.shading);
        const std::string subtitle = fmt::format(
            "{}x{} directions over {:.4g} degrees, hogels {} apart; one core", grid.directions_u, grid.directions_v,
            render.field_of_view.across * 180 / std::numbers::pi, format_length(grid.pitch));
        std::vector<RegionTimes> all;
        std::vector<Curve> curves;
        for (const std::string& algorithm : algorithms) {
            if (interrupted_by() != 0) throw Error(ErrorCode::cancelled, "stopped");
            session.detail(fmt::format("{}: {}", name, algorithm));
            all.push_back(time_regions(algorithm, scene, grid, limits));
            curves.push_back(all.back().curve);
            session.detail(fmt::format("{} hogels a side at most, {}", 1 << (curves.back().points.size() - 1),
                                       format_bytes(all.back().bytes)));
        }
        fmt::print("{}; {}.\nMilliseconds a hogel against the side of the region in hogels.\n\n{}\n", title, subtitle,
                   table(all, limits.side));
        std::fflush(stdout);
        PlotText text{title, subtitle, "Side of the region (hogels)", "Time for each hogel (ms)"};
        text.notes = notes(name, all);
        const auto reference = std::ranges::find(curves, "zbuffer", &Curve::name);
        if (const ThesisScene* known = thesis_scene(name); known && known->faster > 0 && reference != curves.end())
            text.levels.emplace_back(fmt::format("{:g}:1, [K]", known->faster),
                                     reference->points.front().second / known->faster);
        if (folder)
            write_text(folder->path() / fmt::format("render_{}.svg", std::filesystem::path(name).stem().string()),
                       plot_svg(text, curves));
    }
    return 0;
}

// A scene's name, and how finely its triangles are to be cut.
std::pair<std::string, std::size_t> named_scene(const std::string& name) {
    const std::size_t colon = name.rfind(':');
    if (colon == std::string::npos || colon + 1 == name.size() ||
        name.find_first_not_of("0123456789", colon + 1) != std::string::npos)
        return {name, 1};
    return {name.substr(0, colon), std::stoul(name.substr(colon + 1))};
}

}  // namespace

std::string bench_shading(const std::string& scene, const BenchRenderOptions& options) {
    if (!options.shading.empty()) return options.shading;
    const ThesisScene* known = thesis_scene(named_scene(scene).first);
    return known ? known->shading : std::string(defaults.shading);
}

std::shared_ptr<const ShadedScene> bench_scene(const Session& session, const std::string& name,
                                               const RenderOptions& render) {
    const auto [plain, parts] = named_scene(name);
    if (input_kind(plain) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", plain));
    Scene scene = behind(load_scene(session, plain, render), 0.05 * render.size);
    if (parts != 1) scene = scene::tessellate(scene, parts);
    return shade_scene(session, scene, render);
}

void add_bench_render(CLI::App& app, Session& session) {
    auto options = std::make_shared<BenchRenderOptions>();
    options->render.hogels = {defaults.bench_hogels, defaults.bench_hogels};
    options->render.directions = {defaults.bench_directions, defaults.bench_directions};
    options->render.field_of_view = {defaults.bench_field_of_view, defaults.bench_field_of_view};
    CLI::App* command =
        add_command(app, session, "render", "Measure renderers: time per hogel against the size of the region",
                    "  hogel bench render -o plots\n"
                    "  hogel bench render --scenes pumpkin --algorithms zbuffer,simplex,epi --largest 32\n"
                    "  hogel bench render --peers --scenes church,pumpkin:10 --threads 2\n"
                    "  hogel bench render --scaling -o plots\n"
                    "  hogel bench render --stream --scenes pumpkin --hogels 512 --directions 256",
                    {});
    command->add_option("-o,--output", options->output, "Folder for a plot of each scene, SVG")->type_name("DIR");
    command
        ->add_option("--scenes", options->scenes,
                     "Scenes; pumpkin:10 is one whose triangles are cut into 10 x 10 each; those of the thesis if "
                     "none are named")
        ->type_name("SCENE,...")
        ->delimiter(',');
    command->add_option("--algorithms", options->algorithms, "Renderers; all if none are named")
        ->type_name("NAME,...")
        ->delimiter(',');
    command->add_option("--shading", options->shading, "Model of shading; if none is named, that of the thesis")
        ->type_name("NAME");
    CLI::Option* spacing =
        command
            ->add_option("--cache-spacing", options->render.cache_spacing,
                         fmt::format("As hogel render has it, where light depends on the point; 0, anew for each ray, "
                                     "if none is given, but {:g} with --scaling and --stream",
                                     defaults.cache_spacing))
            ->type_name("F")
            ->check(CLI::Range(0.0, 16.0).description(""));
    add_count(command, "--largest", options->limits.side, "Largest side of a region, in hogels");
    CLI::Option* seconds = command
                               ->add_option("--seconds", options->limits.seconds,
                                            fmt::format("Enlarge a region no more that would take longer; with "
                                                        "--peers, of each peer in a round ({:g})",
                                                        defaults.bench_peer_seconds))
                               ->type_name("S")
                               ->check(CLI::Range(1e-3, 1e6).description(""))
                               ->capture_default_str();
    command
        ->add_option("--memory", options->gigabytes, "Enlarge a region no more that would take more, at 20 bytes a ray")
        ->type_name("GB")
        ->check(CLI::Range(1e-3, 1e6).description(""))
        ->capture_default_str();
    CLI::Option* hogels =
        add_counts(command, "--hogels", options->render.hogels,
                   fmt::format("Hogels across and down; with --peers {0}x{0} and {1}x{1}, with --scaling "
                               "{0}x{0}, with --stream {2}x{2}",
                               defaults.bench_few_hogels, defaults.bench_hogels, defaults.bench_stream_hogels));
    CLI::Option* directions =
        add_counts(command, "--directions", options->render.directions,
                   fmt::format("Directions across and down in each hogel; with --peers and --stream {0}x{0}",
                               defaults.bench_peer_directions));
    add_length(command, "--size", options->render.size, "Width of the hologram");
    add_angles(command, "--fov", options->render.field_of_view, "Field of view, the full angle; or across and down");
    std::string known;
    std::vector<std::string> names{""};
    for (const RenderPeerInfo& peer : render_peers()) {
        known += (known.empty() ? "" : ", ") + peer.name;
        names.push_back(peer.name);
    }
    CLI::Option* peers =
        command
            ->add_option("--peers", options->peers,
                         fmt::format("Instead: samples a second, side by side with others: {}; all if none are named; "
                                     "the first of --algorithms, or {}",
                                     known, defaults.algorithm))
            ->type_name("NAME,...")
            ->expected(0, static_cast<int>(render_peers().size()))
            ->delimiter(',')
            ->check(CLI::IsMember(names).description(""));
    CLI::Option* scaling = command->add_flag("--scaling", options->scaling,
                                             "Instead: how the time grows with hogels, directions and triangles, and "
                                             "what a second thread gains");
    CLI::Option* stream = command->add_flag("--stream", options->stream,
                                            "Instead: whole light fields, which may be larger than memory, into a "
                                            "sink that keeps nothing of them");
    scaling->excludes(peers);
    stream->excludes(peers)->excludes(scaling);
    add_count(command, "--rounds", options->rounds, "Rounds of which --peers and --scaling take medians");
    command->callback([=, &session] {
        session.command = command;
        session.run = [=, &session] {
            options->own_hogels = hogels->count() > 0;
            options->own_directions = directions->count() > 0;
            options->own_seconds = seconds->count() > 0;
            options->own_spacing = spacing->count() > 0;
            if (peers->count() > 0) return bench_render_peers(*options, session);
            if (options->scaling) return bench_render_scaling(*options, session);
            if (options->stream) return bench_render_stream(*options, session);
            return bench_regions(*options, session);
        };
    });
}

}  // namespace hogel::cli
