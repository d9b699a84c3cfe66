// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "hogel/bake.h"
#include "hogel/compress.h"
#include "hogel/light_field.h"
#include "hogel/photograph.h"
#include "hogel/render/cache_spacing.h"
#include "hogel/renderer.h"
#include "hogel/scene_hologram.h"
#include "hogel/scenes.h"
#include "hogel/shading.h"
#include "hogel/shading/light_cache.h"

namespace hogel::cli {
namespace {

// A light field up to this size is kept in memory rather than rendered again each time that it is read.
constexpr double kept_bytes = 2e9;
// Of a larger one rows of hogels are kept up to this, while the squares that they hold are read.
constexpr double kept_tile_bytes = 1e9;

bool is_builtin(const std::string& name) { return scenes().look_up(name) != nullptr; }

// What the user calls a method or its phases, and the library's word for it.
const std::map<std::string, Method> methods{
    {"fourier", Method::fourier}, {"basis", Method::basis}, {"olas", Method::overlap_add}};
const std::map<std::string, LobeAverage> averages{{"radiance", LobeAverage::radiance},
                                                  {"amplitude", LobeAverage::amplitude}};
const std::map<std::string, Phases> phases{{"random", Phases::random},
                                           {"fixed", Phases::fixed},
                                           {"designed", Phases::designed},
                                           {"phase-added", Phases::phase_added},
                                           {"phase-added-exact", Phases::phase_added_exact}};

Phases phases_of(const HologramChoices& options) {
    if (!options.phase.empty()) return phases.at(options.phase);
    return methods.at(options.method) == Method::basis ? Phases::fixed : Phases::random;
}

HologramOptions stereogram_options(const LightFieldGrid& light_field, const HologramChoices& options,
                                   double wavelength) {
    HologramOptions stereogram;
    stereogram.wavelength = wavelength;
    stereogram.pitch = options.pitch;
    stereogram.channel = light_field.channels == 1 ? 0 : colour_of(wavelength);
    stereogram.method = methods.at(options.method);
    stereogram.phases = phases_of(options);
    stereogram.average = averages.at(options.average);
    stereogram.transform = options.basis.empty() ? std::string(defaults.basis) : options.basis;
    stereogram.tolerance = options.tolerance;
    stereogram.line_pitch = options.lines;
    return stereogram;
}

}  // namespace

LightFieldGrid RenderOptions::grid() const {
    if (!(size > 0)) throw Error(ErrorCode::usage, "--size: the hologram's side must be positive");
    LightFieldGrid grid;
    grid.hogels_s = hogels.columns;
    grid.hogels_t = hogels.rows;
    grid.pitch = size / static_cast<double>(hogels.columns);
    grid.directions_u = directions.columns;
    grid.directions_v = directions.rows;
    grid.view = hogel::field_of_view(field_of_view.across, field_of_view.down, toward.across, toward.down);
    if (frequencies > 0) {
        // As many frequencies j/d as the field of view holds.
        const double step = frequencies / grid.pitch;
        const auto reach = [&](double angle) { return std::floor(std::sin(angle / 2) / step + 1e-9); };
        const double across = 2 * reach(field_of_view.across) + 1, down = 2 * reach(field_of_view.down) + 1;
        grid.directions_u = static_cast<std::size_t>(across);
        grid.directions_v = static_cast<std::size_t>(down);
        grid.view = Frequencies{{0.5 * across * step, 0.5 * down * step}};
    }
    validate(grid, ErrorCode::usage, "light field");
    return grid;
}

std::vector<LightFieldGrid> RenderOptions::grids() const {
    return hemicube ? hogel::hemicube(grid()) : std::vector{grid()};
}

void add_render_options(CLI::App* command, RenderOptions& options) {
    const auto group = [](CLI::Option* option) { option->group("Light field of a scene"); };
    std::string algorithms;
    for (const RendererInfo& renderer : renderers())
        algorithms += fmt::format("\n{}: {}", renderer.name, renderer.description);
    group(command->add_option("--algorithm", options.algorithm, "Renderer:" + algorithms)
              ->type_name("NAME")
              ->capture_default_str());
    std::string shadings;
    for (const ShadingInfo& shading : shading_models())
        shadings += fmt::format("\n{}: {}", shading.name, shading.description);
    group(command->add_option("--shading", options.shading, "Where light is worked out:" + shadings)
              ->type_name("NAME")
              ->capture_default_str());
    group(add_count(command, "--shadow-map", options.shadow_map, "Texels along a side of a lamp's shadow map"));
    group(command
              ->add_option("--cache-spacing", options.cache_spacing,
                           "Of the points of a surface at which light is worked out, in parts of the width of a ray "
                           "there, where it depends on the point (direct, shadowed); 0: anew for each ray")
              ->type_name("F")
              ->check(CLI::Range(0.0, 16.0).description(""))
              ->capture_default_str());
    group(command->add_flag("--cull-back-faces", options.fronts_only,
                            "Show triangles from their front alone, where their corners go round counterclockwise"));
    group(add_counts(command, "--hogels", options.hogels, "Hogels across and down"));
    group(add_counts(command, "--directions", options.directions, "Directions across and down in each hogel"));
    group(add_counts(command, "--samples", options.samples,
                     "Samples averaged for each ray: along a hogel's side and along a direction's; 2 is 2x2, which "
                     "makes 16"));
    group(add_length(command, "--size", options.size, "Width of the hologram"));
    group(add_angles(command, "--fov", options.field_of_view, "Field of view, the full angle; or across and down"));
    group(add_angles(command, "--toward", options.toward,
                     "Where the middle of the view looks behind the hologram: angles to the right and up"));
    group(command
              ->add_option("--front", options.front,
                           "How much of a mesh file's depth stands in front of the hologram: 0 none, 1 all; -0.1: it "
                           "begins a tenth of its depth behind it")
              ->type_name("F")
              ->check(CLI::Range(-100.0, 1.0).description(""))
              ->capture_default_str());
    CLI::Option* as_is = command->add_flag("--as-is", options.as_is,
                                           "Take a mesh file where it is, its numbers as metres, z towards the viewer");
    group(as_is);
    group(command
              ->add_flag_function(
                  "--fit", [](std::int64_t) {}, "Scale and move a mesh file to fill the hologram (default)")
              ->excludes(as_is));
}

void add_hemicube_option(CLI::App* command, RenderOptions& options) {
    command
        ->add_flag(
            "--hemicube", options.hemicube,
            "All directions behind the hologram, in five faces: 90 degrees in front, and four halves at the sides")
        ->group("Light field of a scene")
        ->excludes("--fov")
        ->excludes("--toward");
}

void add_frequencies_option(CLI::App* command, RenderOptions& options) {
    add_length(command, "--frequencies", options.frequencies,
               "Directions on the frequency grid of a hologram of this wavelength, as many as the field of view holds; "
               "with --algorithm raytrace")
        ->group("Light field of a scene")
        ->excludes("--hemicube")
        ->excludes("--directions")
        ->excludes("--toward");
}

void add_hologram_options(CLI::App* command, HologramChoices& options) {
    const auto group = [](CLI::Option* option) { option->group("Hologram"); };
    group(add_wavelengths(command, options.wavelengths));
    group(add_length(command, "--pitch", options.pitch, "Distance of samples, rounded to divide a hogel"));
    group(add_length(command, "--line-pitch", options.lines,
                     "Horizontal parallax only, in lines this far apart; for light fields of Nx1 directions"));
    group(command
              ->add_option("--method", options.method,
                           "fourier: one transform a hogel\n"
                           "basis: a sum of basis fringes a hogel\n"
                           "olas: overlapping windows, for hogels of a few samples; needs depth")
              ->type_name("NAME")
              ->check(CLI::IsMember(methods).description(""))
              ->capture_default_str());
    group(command
              ->add_option("--phase", options.phase,
                           "Phases of each hogel's directions\n"
                           "random: independent everywhere (default)\n"
                           "fixed: the same in all hogels (basis: default; olas: none, a smooth surface)\n"
                           "designed: the same in all hogels, for a fringe of flat modulus\n"
                           "phase-added: of spherical waves from what rays meet; needs depth\n"
                           "phase-added-exact: the same, each ray with its own frequency")
              ->type_name("NAME")
              ->check(CLI::IsMember(phases).description("")));
    group(command
              ->add_option("--lobes", options.average,
                           "What a hogel's lobes take from the directions that they light: their mean radiance, or "
                           "(always with basis) mean amplitude")
              ->type_name("radiance|amplitude")
              ->check(CLI::IsMember(averages).description(""))
              ->capture_default_str());
    group(command
              ->add_option("--basis", options.basis,
                           fmt::format("Transform of the directions whose basis fringes are summed: pieces (one a "
                                       "direction), {} (default: the file's, or {})",
                                       fmt::join(transform_names(), ", "), defaults.basis))
              ->type_name("NAME"));
    group(command
              ->add_option("--tolerance", options.tolerance,
                           "Share of a hogel's amplitude that left-out basis fringes may carry")
              ->type_name("0..1")
              ->check(CLI::Range(0.0, 1.0).description(""))
              ->capture_default_str());
}

void add_scene_hologram_options(CLI::App* command, HologramChoices& options) {
    std::string names;
    std::vector<std::string> known;
    for (const auto& [name, method] : methods) known.push_back(name);
    for (const SceneMethod& method : scene_methods()) {
        known.emplace_back(method.name);
        names += fmt::format("\n{}: {}", method.name, method.description);
    }
    CLI::Option* method = command->get_option("--method");
    method->description(method->get_description() + "\nWithout a light field, from a scene:" + names);
    CLI::Validator* check = method->get_validator();
    *check = CLI::IsMember(known).description("");
    const auto group = [](CLI::Option* option) { option->group("Hologram"); };
    group(add_length(command, "--spacing", options.spacing,
                     "Of points on surfaces and along edges; height of hpo lines"));
    group(add_count(command, "--planes", options.planes, "Depth planes of fresnel and planes"));
}

InputKind input_kind(const std::string& name) {
    if (is_builtin(name)) return InputKind::scene;
    if (!std::filesystem::exists(name)) {
        if (name.find_first_of("./") != std::string::npos)
            throw Error(ErrorCode::bad_input, fmt::format("{}: no such file", name));
        make_scene(name, defaults.size);  // knows the names that exist, and says so
    }
    switch (file_kind(name)) {
        case FileKind::light_field:
            return InputKind::light_field;
        case FileKind::hologram:
            return InputKind::hologram;
        case FileKind::mesh:
            return InputKind::scene;
        case FileKind::picture:
            throw Error(ErrorCode::bad_input,
                        fmt::format("{}: is a picture; expected a scene, a light field or a hologram", name));
        case FileKind::unknown:
            break;
    }
    throw Error(ErrorCode::bad_input, fmt::format("{}: is neither a mesh, a light field nor a hologram", name));
}

Scene load_scene(const Session& session, const std::string& name, const RenderOptions& options) {
    if (is_builtin(name)) {
        Stage stage(session, "scene");
        return make_scene(name, options.size, stage.progress());
    }
    Scene scene = import_scene(name);
    if (!options.as_is) {
        Fit fit;
        fit.width = options.size;
        fit.height =
            options.size * static_cast<double>(options.hogels.rows) / static_cast<double>(options.hogels.columns);
        fit.front = options.front;
        fit_scene(scene, fit);
    }
    if (scene.lights.empty()) add_default_lights(scene);
    return scene;
}

std::shared_ptr<const ShadedScene> shade_scene(const Session& session, const Scene& scene,
                                               const RenderOptions& options) {
    ShadingOptions shading;
    shading.model = shading_model(options.shading);
    shading.shadow_map = options.shadow_map;
    if (const double bytes = shadow_map_bytes(scene, shading); bytes > 0)
        session.detail(fmt::format("shadow maps: {}", format_bytes(bytes)));
    Stage stage(session, "lighting");
    auto shaded = std::make_shared<ShadedScene>(shade_scene(scene, shading, stage.progress()));
    shaded->fronts_only = options.fronts_only;
    if (options.cache_spacing > 0)
        shading::cache_light(*shaded, render::cache_spacing(*shaded, finer(options.grid(), options.samples_per_ray()),
                                                            options.cache_spacing));
    if (const auto& cache = shaded->light_cache)
        session.detail(fmt::format("light on surfaces: at most {}; no room for that of {} of {} triangles",
                                   format_bytes(cache->bytes()), cache->triangles_without_room(),
                                   shaded->triangles.size()));
    return shaded;
}

std::unique_ptr<LightFieldSource> render_on_demand(const Session& session, const Scene& scene,
                                                   const RenderOptions& options) {
    return make_renderer(options.algorithm, shade_scene(session, scene, options), options.grid(),
                         options.samples_per_ray());
}

std::vector<std::unique_ptr<LightFieldSource>> render_faces_on_demand(const Session& session, const Scene& scene,
                                                                      const RenderOptions& options) {
    const std::shared_ptr<const ShadedScene> shaded = shade_scene(session, scene, options);
    std::vector<std::unique_ptr<LightFieldSource>> faces;
    for (const LightFieldGrid& grid : options.grids())
        faces.push_back(make_renderer(options.algorithm, shaded, grid, options.samples_per_ray()));
    return faces;
}

std::unique_ptr<LightFieldSource> open_or_render(const Session& session, const std::string& name,
                                                 const RenderOptions& options) {
    if (input_kind(name) == InputKind::light_field) return open_light_field(name);
    return render_on_demand(session, load_scene(session, name, options), options);
}

std::vector<std::unique_ptr<LightFieldSource>> open_for_hologram(const std::string& name, HologramChoices& hologram) {
    if (methods.at(hologram.method) == Method::basis && is_stream(name)) {
        const StreamInfo info = read_stream_info(name);
        const CodingMethod& stored = info.method;
        if (stored.coder == "fringes" && !info.tone && info.chrominance == 1 &&
            (hologram.basis.empty() || hologram.basis == stored.transform)) {
            hologram.basis = stored.transform;
            hologram.coefficients = true;
            std::vector<std::unique_ptr<LightFieldSource>> coefficients;
            coefficients.push_back(open_coefficients(name));
            return coefficients;
        }
    }
    return open_light_field_faces(name);
}

std::vector<std::unique_ptr<LightFieldSource>> open_or_render_faces(const Session& session, const std::string& name,
                                                                    const RenderOptions& options) {
    if (input_kind(name) == InputKind::light_field) return open_light_field_faces(name);
    return render_faces_on_demand(session, load_scene(session, name, options), options);
}

bool needs_depth(const HologramChoices& options) {
    HologramOptions stereogram;
    stereogram.method = methods.at(options.method);
    stereogram.phases = phases_of(options);
    return needs_depth(stereogram);
}

namespace {

// A face that is shared with others.
class SharedFace final : public LightFieldSource {
  public:
    explicit SharedFace(LightField::Source face) : face_(std::move(face)) {}
    const LightFieldGrid& grid() const override { return face_->grid(); }
    bool has_depth() const override { return face_->has_depth(); }
    HogelRange preferred_tile() const override { return face_->preferred_tile(); }
    void read(LightFieldTile& tile) const override { face_->read(tile); }

  private:
    LightField::Source face_;
};

}  // namespace

std::vector<std::unique_ptr<LightFieldSource>> render_for_reading(const Session& session,
                                                                  std::vector<std::unique_ptr<LightFieldSource>> faces,
                                                                  std::size_t times, bool with_depth) {
    double samples = 0;
    for (const auto& face : faces) samples += face->grid().samples();
    if (times == 1 || samples * sizeof(float) > kept_bytes) {
        std::vector<LightField::Source> shared;
        for (auto& face : faces) shared.push_back(std::move(face));
        const LightField cached = cached_tiles(LightField(std::move(shared)), kept_tile_bytes, with_depth);
        for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = std::make_unique<SharedFace>(cached.faces()[i]);
        return faces;
    }
    Stage stage(session, "rendering");
    for (std::size_t i = 0; i < faces.size(); ++i) {
        auto light_field = std::make_unique<LightFieldBuffer>(faces[i]->grid(), with_depth);
        copy(*faces[i], *light_field, stage.progress(i, faces.size()));
        faces[i] = std::move(light_field);
    }
    return faces;
}

std::vector<LightFieldGrid> grids_of(std::span<const std::unique_ptr<LightFieldSource>> faces) {
    std::vector<LightFieldGrid> grids;
    for (const auto& face : faces) grids.push_back(face->grid());
    return grids;
}

void require_holograms(std::span<const LightFieldGrid> faces, const HologramChoices& options,
                       std::span<const Camera> cameras) {
    // The shortest wavelength is diffracted least, and has the finest detail in the light that enters a lens.
    const double shortest = *std::ranges::min_element(options.wavelengths);
    const FieldGrid hologram = hologram_grid(faces, stereogram_options(faces.front(), options, shortest));
    require_photographs(hologram, cameras);
    for (const Camera& camera : cameras) require_light_towards(hologram, camera);
}

std::vector<std::unique_ptr<FieldSource>> make_holograms(const Session& session,
                                                         std::span<const std::unique_ptr<LightFieldSource>> faces,
                                                         const HologramChoices& options, std::size_t looks) {
    std::vector<const LightFieldSource*> sources;
    for (const auto& face : faces) sources.push_back(face.get());
    std::vector<std::unique_ptr<FieldSource>> holograms;
    for (const double wavelength : options.wavelengths) {
        HologramOptions stereogram = stereogram_options(faces.front()->grid(), options, wavelength);
        stereogram.looks = looks;
        stereogram.seed = session.seed;
        holograms.push_back(options.coefficients ? make_hologram_of_coefficients(*sources.front(), stereogram)
                                                 : make_hologram(sources, stereogram));
    }
    return holograms;
}

std::vector<Image> photograph_colours(Stage& stage, std::span<const std::unique_ptr<FieldSource>> holograms,
                                      std::span<const Camera> cameras, const std::optional<FullCameraOptions>& full) {
    const std::size_t colours = holograms.size();
    std::vector<Image> pictures(cameras.size());
    for (std::size_t c = 0; c < colours; ++c) {
        const Progress progress = stage.progress(c, colours);
        const std::vector<Image> seen = full ? photograph_fully(*holograms[c], cameras, progress, *full)
                                             : photograph(*holograms[c], cameras, progress);
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            if (c == 0) pictures[i] = Image(seen[i].width(), seen[i].height(), colours);
            for (std::size_t pixel = 0; pixel < seen[i].pixels.size(); ++pixel)
                pictures[i].pixels.data()[pixel * colours + c] = seen[i].pixels.data()[pixel];
        }
    }
    return pictures;
}

Camera camera_for(double width, double height, std::size_t resolution) {
    const double pixel = width / static_cast<double>(resolution);
    const auto rows = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(height / pixel)));
    Camera camera;
    camera.eye = {0, 0, defaults.eye_distance};
    camera.pupil = defaults.pupil;
    camera.picture = {resolution, rows, pixel, pixel, 0, 0};
    return camera;
}

}  // namespace hogel::cli
