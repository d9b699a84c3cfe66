// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include "error_parameters.h"
#include "hogel/error.h"
#include "hogel/scene_hologram.h"
#include "hogel/units.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

// The names of averages of lobes, and of phases.
const std::vector<std::string> average_names{"radiance", "amplitude"};
const std::vector<std::string> phase_names{"random", "fixed", "designed"};

constexpr const char* light_field_group = "Light field of a scene";

void add_hologram_options(Command& command, HologramChoices& options, const std::vector<std::string>& names,
                          const std::string& help) {
    command.group("Hologram");
    const auto is_sampled = [&options] { return options.is_made || options.is_sampled; };
    const auto is_made = [&options] { return options.is_made; };
    const auto has_lobes = [&options] {
        return options.made_by &&
               (std::holds_alternative<Fourier>(*options.made_by) || std::holds_alternative<Lines>(*options.made_by));
    };
    const auto is_basis = [&options] { return options.made_by && std::holds_alternative<Basis>(*options.made_by); };
    const auto has_phases = [&options] {
        return options.made_by && !std::holds_alternative<PhaseAdded>(*options.made_by) &&
               !std::holds_alternative<OwnMethod>(*options.made_by);
    };
    command.wavelengths(options.wavelengths).acts_if(is_sampled);
    command
        .positive_length("--pitch", options.pitch,
                         "Distance of samples, rounded to divide a hogel; less by default where the field of view "
                         "needs it")
        .acts_if(is_sampled);
    command
        .positive_length("--line-pitch", options.lines,
                         "Distance of the lines of --method lines or basis-lines (default: as far apart as samples)")
        .no_default()
        .acts_if([&options] { return options.made_by && line_pitch(*options.made_by).has_value(); });
    command.choice("--method", options.method, names, "NAME", help).acts_if(is_made);
    command
        .choice("--phase", options.phase, phase_names, "NAME",
                "Phases of each hogel's directions\n"
                "random: independent everywhere (default)\n"
                "fixed: the same in all hogels (basis: default; olas: none, a smooth surface)\n"
                "designed: the same in all hogels, for a fringe of flat modulus")
        .acts_if(has_phases);
    command
        .choice("--lobes", options.average, average_names, "radiance|amplitude",
                "What a hogel's lobes take from the directions that they light: their mean radiance, or "
                "(always with basis) mean amplitude")
        .acts_if(has_lobes);
    command
        .text("--basis", options.basis, "NAME",
              fmt::format("Transform of the directions whose basis fringes are summed: pieces (one a "
                          "direction), {} (default: the file's, or {})",
                          fmt::join(transform_names(), ", "), defaults.basis))
        .acts_if(is_basis);
    command
        .number("--tolerance", options.tolerance, "0..1",
                "Share of a hogel's amplitude that left-out basis fringes may carry")
        .range(0, 1)
        .acts_if(is_basis);
    command.look_up("seed")->acts_if([&options] { return options.is_seeded; });
}

// The methods of the table, with a line of help each.
std::string help_of_methods() {
    std::string help = "How a light field becomes fringes";
    for (const HologramMethodInfo& method : hologram_methods().rows())
        help += fmt::format("\n{}: {}{}", method.name, method.text, method.needs_depth ? "; needs depth" : "");
    return help;
}

// Gives a method the options of the command line; refuses those that it does not have.
struct Adjust {
    const HologramChoices& choices;

    void operator()(Fourier& method) const {
        method.phases = phases(Phases::random);
        method.average = average();
    }
    void operator()(Lines& method) const {
        method.line_pitch = choices.lines;
        method.phases = phases(Phases::random);
        method.average = average();
    }
    void operator()(Basis& method) const {
        const Phases chosen = phases(Phases::fixed);
        if (chosen == Phases::random)
            refuse("basis fringes have the same phases in all hogels; expected fixed or designed");
        method.phases = chosen == Phases::designed ? SharedPhases::designed : SharedPhases::fixed;
        method.transform = choices.basis.empty() ? std::string(defaults.basis) : choices.basis;
        method.tolerance = choices.tolerance;
        if (method.line_pitch) method.line_pitch = choices.lines;
    }
    void operator()(PhaseAdded&) const {
        if (!choices.phase.empty()) refuse("is not for --method phase-added, whose phases are those of the points");
    }
    void operator()(OverlapAdd& method) const {
        const Phases chosen = phases(Phases::random);
        if (chosen == Phases::designed) refuse("is not for --method olas; expected random or fixed");
        method.phases = chosen == Phases::fixed ? PointPhases::fixed : PointPhases::random;
    }
    void operator()(OwnMethod&) const {}

  private:
    Phases phases(Phases otherwise) const {
        return choices.phase == "random"     ? Phases::random
               : choices.phase == "fixed"    ? Phases::fixed
               : choices.phase == "designed" ? Phases::designed
                                             : otherwise;
    }
    LobeAverage average() const {
        return choices.average == "amplitude" ? LobeAverage::amplitude : LobeAverage::radiance;
    }
    void refuse(const char* expected) const {
        throw Error(ErrorCode::usage, fmt::format("--phase {}: {}", choices.phase, expected));
    }
};

}  // namespace

LightFieldGrid RenderOptions::grid() const {
    LightFieldGrid grid;
    grid.hogels_s = hogels.columns;
    grid.hogels_t = hogels.rows;
    grid.pitch = size / static_cast<double>(hogels.columns);
    grid.directions_u = directions.columns;
    grid.directions_v = directions.rows;
    // The faces of a hemicube have ranges of their own, but for the height of a single row of directions.
    const Angles view = hemicube ? Angles{defaults.field_of_view, defaults.field_of_view} : field_of_view;
    grid.view = hogel::field_of_view(view.across, view.down, toward.across, toward.down);
    if (focal_plane_given) grid.view = FocalPlane{grid.range(), focal_plane};
    if (frequencies > 0) {
        // As many frequencies j/d as fit into the field of view.
        const double step = frequencies / grid.pitch;
        const auto reach = [&](double angle) { return std::floor(std::sin(angle / 2) / step + 1e-9); };
        const double across = 2 * reach(field_of_view.across) + 1, down = 2 * reach(field_of_view.down) + 1;
        grid.directions_u = static_cast<std::size_t>(across);
        grid.directions_v = static_cast<std::size_t>(down);
        grid.view = Frequencies{{0.5 * across * step, 0.5 * down * step}};
    }
    with_renamed_parameters({{"directions", frequencies > 0 ? "frequencies" : "directions"}},
                            [&] { validate(grid, ErrorCode::usage, "light field"); });
    return grid;
}

LightFieldRequest RenderOptions::request(const Scene& loaded) const {
    LightFieldRequest wanted = request();
    wanted.shading.model = shading_model(loaded, wanted.shading);
    return wanted;
}

LightFieldRequest RenderOptions::request() const {
    renderers().find(algorithm);
    shading_models().find(shading);
    LightFieldRequest request;
    request.renderer = algorithm;
    request.shading.model = shading;
    request.shading.shadow_map = shadow_map;
    request.cache_spacing = cache_spacing;
    request.grid = grid();
    request.hemicube = hemicube;
    if (hemicube && field_of_view_given) {
        request.hemicube_across = field_of_view.across;
        request.hemicube_down = field_of_view.down;
    }
    request.samples = {samples.columns, samples.rows};
    request.cull_back_faces = fronts_only;
    if (interpolate_given) request.interpolate = interpolate;
    request.fit = !as_is;
    request.front = front;
    request.grids();
    with_renamed_parameters({{"directions", "directions, samples"}}, [&] { finer(request.grid, request.samples); });
    return request;
}

HologramMethod HologramChoices::hologram_method() const {
    const std::vector<std::string> known = transform_names();
    if (!basis.empty() && basis != "pieces" && !std::ranges::count(known, basis))
        throw_unknown("transform", basis, known, "basis");
    HologramMethod chosen = hologram_methods().find(method).method;
    if (lines > 0 && !line_pitch(chosen))
        throw Error(ErrorCode::usage,
                    fmt::format("--line-pitch: belongs to --method lines or basis-lines, not {}", method));
    std::visit(Adjust{*this}, chosen);
    return chosen;
}

HologramRequest HologramChoices::request(const Session& session, std::size_t looks) const {
    HologramRequest request;
    request.channels.clear();
    for (const double wavelength : wavelengths) request.channels.push_back({wavelength, channel_of(wavelength)});
    request.pitch = pitch;
    request.method = hologram_method();
    request.looks = looks;
    request.seed = session.seed;
    return request;
}

void HologramChoices::resolve(const HologramRequest& request, const LightFieldGrid& front) {
    is_made = true;
    made_by = request.method;
    // The samples divide a hogel evenly, so they may be a little farther apart or closer than was asked.
    const double columns = std::max(1.0, std::round(front.pitch / request.pitch)), effective = front.pitch / columns;
    if (std::abs(effective - pitch) > 1e-9 * pitch) pitch = effective;
    if (const std::optional<double> apart = line_pitch(request.method)) lines = *apart > 0 ? *apart : effective;
    if (const auto* fringes = std::get_if<Basis>(&request.method)) basis = fringes->transform;
    if (phase.empty()) phase = std::holds_alternative<Basis>(request.method) ? "fixed" : "random";
    const auto* windows = std::get_if<OverlapAdd>(&request.method);
    is_seeded = windows == nullptr || windows->phases == PointPhases::random;
}

void check_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request, bool rendered,
                     std::span<const Camera> cameras) {
    const auto check = [&] { hogel::require_holograms(faces, request, cameras); };
    if (rendered) return check();
    with_renamed_parameters({{"fov", ""}, {"toward", ""}, {"size", ""}, {"hogels", ""}, {"directions", ""}}, check);
}

void add_render_options(Command& command, RenderOptions& options) {
    const auto is_rendered = [&options] { return options.is_rendered; };
    command.group(light_field_group, [&options] { return options.scene.is_loaded; });
    std::string algorithms;
    for (const RendererInfo& renderer : renderers().rows())
        algorithms += fmt::format("\n{}: {}", renderer.name, renderer.text);
    command.text("--algorithm", options.algorithm, "NAME", "Renderer:" + algorithms)
        .acts_if(is_rendered)
        .knows(renderers().names());
    std::string shadings;
    for (const ShadingInfo& shading : shading_models().rows())
        shadings += fmt::format("\n{}: {}", shading.name, shading.text);
    command.text("--shading", options.shading, "NAME", "Where light is computed:" + shadings)
        .knows(shading_models().names())
        .acts_if([&options] { return options.scene.is_lit; });
    command.count("--shadow-map", options.shadow_map, "Texels along a side of a lamp's shadow map").acts_if([&options] {
        return options.has_shadow_maps;
    });
    command
        .number("--cache-spacing", options.cache_spacing, "F",
                "Spacing of the points of a surface at which light is computed, in widths of a ray "
                "there, where it depends on the point (direct, shadowed); 0: anew for each ray")
        .range(0, 16)
        .acts_if([&options] { return options.is_lit_by_samples; });
    command
        .flag("--cull-back-faces", options.fronts_only,
              "Show only the front of triangles, the side from which their corners are counterclockwise")
        .acts_if(is_rendered);
    command.counts("--hogels", options.hogels, "Hogels across and down");
    command.counts("--directions", options.directions, "Directions across and down in each hogel").acts_if([&options] {
        return options.is_rendered && options.frequencies == 0;
    });
    command
        .counts("--samples", options.samples,
                "Samples averaged for each ray: along a hogel's side and along a direction's; 2 is 2x2, which "
                "makes 16")
        .acts_if(is_rendered);
    command.positive_length("--size", options.size, "Width of the hologram");
    command.angles("--fov", options.field_of_view, "Field of view, the full angle; or across and down")
        .sets(options.field_of_view_given)
        .acts_if(is_rendered);
    command
        .angles("--toward", options.toward,
                "Where the middle of the view looks behind the hologram: angles to the right and up")
        .acts_if([&options] { return options.is_rendered && !options.hemicube && options.frequencies == 0; });
    command
        .number("--front", options.front, "F",
                "How much of a mesh file's depth stands in front of the hologram: 0 none, 1 all; -0.1: it "
                "begins a tenth of its depth behind it")
        .range(-100, 1)
        .acts_if([&options] { return options.scene.is_file && !options.as_is; });
    const Parameter& as_is =
        command
            .flag("--as-is", options.as_is, "Take a mesh file where it is, its numbers as metres, z towards the viewer")
            .acts_if([&options] { return options.scene.is_file; });
    command.flag("--fit", "Scale and move a mesh file to fill the hologram (default)").excludes(as_is).never_acts();
    add_scene_options(command, options.scene);
}

void add_hemicube_option(Command& command, RenderOptions& options) {
    command.group(light_field_group);
    command
        .flag("--hemicube", options.hemicube,
              "All directions behind the hologram, in five faces: 90 degrees in front, and four halves at the sides; "
              "with --fov of more than 90 degrees, shorter sides")
        .excludes("--toward")
        .acts_if([&options] { return options.is_rendered && options.frequencies == 0 && !options.focal_plane_given; });
}

void add_direction_options(Command& command, RenderOptions& options) {
    command.group(light_field_group);
    command
        .length(
            "--focal-plane", options.focal_plane,
            "Depth behind the hologram of a fixed focal plane, whose points are those of all hogels, negative in front "
            "of it, where cameras would stand; --fov and --toward are those of the middle of the hologram (default: "
            "none, hogels have the same directions)")
        .no_default()
        .sets(options.focal_plane_given)
        .excludes("--hemicube");
    command
        .positive_length(
            "--frequencies", options.frequencies,
            "Directions on the frequency grid of a hologram of this wavelength, as many as the field of view holds; "
            "with --algorithm raytrace, zbuffer or oblique")
        .no_default()
        .excludes("--hemicube")
        .excludes("--focal-plane")
        .excludes("--directions")
        .excludes("--toward");
    command
        .count("--interpolate", options.interpolate,
               "With --algorithm simplex: shade the corners of triangles as seen from the corners of regions of N x N "
               "hogels, and interpolate between them (default: shade every sample)")
        .no_default()
        .sets(options.interpolate_given)
        .excludes("--hemicube")
        .excludes("--frequencies")
        .excludes("--focal-plane");
}

void add_hologram_options(Command& command, HologramChoices& options) {
    add_hologram_options(command, options, hologram_methods().names(), help_of_methods());
}

void add_scene_hologram_options(Command& command, HologramChoices& options) {
    std::vector<std::string> names = hologram_methods().names();
    std::string help = help_of_methods() + "\nWithout a light field, from a scene:";
    for (const SceneHologramMethod& method : scene_hologram_methods().rows()) {
        names.emplace_back(method.name);
        help += fmt::format("\n{}: {}", method.name, method.text);
    }
    add_hologram_options(command, options, names, help);
    command.positive_length("--spacing", options.spacing, "Of points on surfaces and along edges; height of hpo lines")
        .acts_if([&options] { return options.has_spacing; });
    command.count("--planes", options.planes, "Depth planes of fresnel and planes").acts_if([&options] {
        return options.has_planes;
    });
}

LightFieldRequest scene_request(const RenderOptions& options) {
    LightFieldRequest request = options.request();
    request.pose = options.scene.complete_pose();
    request.import.point_size = options.scene.point_size;
    if (!request.pose.camera.empty() && (request.pose.up || request.pose.rotation != Vec3{} || options.as_is))
        throw Error(ErrorCode::usage,
                    "--scene-camera: turns and fits the scene itself; leave out --up, --rotate and --as-is");
    return request;
}

Scene load_scene(const Session& session, const std::string& name, RenderOptions& options) {
    const LightFieldRequest request = scene_request(options);
    Stage stage(session, "scene");
    Scene scene = hogel::load_scene(name, request, stage.progress());
    SceneOptions& known = options.scene;
    known.is_loaded = true;
    known.is_file = scenes().look_up(name) == nullptr;
    known.is_lit = std::ranges::any_of(scene.meshes, [](const Mesh& mesh) { return mesh.radiance.empty(); });
    known.has_points = std::ranges::any_of(scene.meshes, [](const Mesh& mesh) { return mesh.name == points_name; });
    for (const std::string& note : scene.notes) session.say(fmt::format("{}: note: {}", name, note));
    return scene;
}

std::shared_ptr<const ShadedScene> light_scene(const Session& session, const Scene& scene, RenderOptions& options) {
    const LightFieldRequest request = options.request();
    options.shading = shading_model(scene, request.shading);
    if (request.shading.model == "auto" && options.shading == "direct")
        session.detail(fmt::format("shading: direct, because {}", scene.has_large_triangles
                                                                      ? "its triangles are large"
                                                                      : "of its maps of gloss or relief"));
    if (const double bytes = shadow_map_bytes(scene, request.shading); bytes > 0) {
        options.has_shadow_maps = true;
        session.detail(fmt::format("shadow maps: {}", format_bytes(bytes)));
    }
    Stage stage(session, "lighting");
    return hogel::light_scene(scene, request, stage.progress());
}

LightField render_light_field(const Session& session, const Scene& scene, RenderOptions& options) {
    options.is_rendered = true;
    if (options.hemicube && !options.field_of_view_given) options.field_of_view = {std::numbers::pi, std::numbers::pi};
    const LightFieldRequest request = options.request();
    const auto lit = light_scene(session, scene, options);
    for (std::size_t i = 0; i < lit->triangles.size() && !options.is_lit_by_samples; ++i)
        options.is_lit_by_samples = lit->is_lit(i);
    return with_parameter(options.frequencies > 0 ? "algorithm, frequencies" : "algorithm",
                          [&] { return hogel::render_light_field(lit, request); });
}

void require_memory(const Session& session, const LightField& rendered, const RenderOptions& options,
                    const Scene& scene) {
    const Plan plan = plan_light_field(rendered, options.request(scene), triangle_count(scene));
    with_parameter("hogels, directions", [&] { state_plan(session, plan, "rendering by " + options.algorithm); });
}

LightField open_or_render(const Session& session, const std::string& name, RenderOptions& options) {
    if (input_kind(name) == InputKind::light_field) return open_light_field_or_views(name);
    const Scene scene = load_scene(session, name, options);
    LightField rendered = render_light_field(session, scene, options);
    require_memory(session, rendered, options, scene);
    return rendered;
}

LightField prepare_for_reading(const Session& session, const LightField& light_field, std::size_t times,
                               bool with_depth) {
    Stage stage(session, "rendering");
    return hogel::prepare_for_reading(light_field, times, with_depth, stage.progress());
}

}  // namespace hogel::cli
