// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "commands.h"
#include "hogel/hologram/parallax.h"
#include "hogel/scene_hologram.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    RenderOptions render;
    HologramChoices hologram;
    bool half = false, resume = false;

    HologramFileOptions file(const Session& session) const {
        HologramFileOptions file;
        file.type = half ? SampleType::half : SampleType::single;
        file.metadata = describe_run(session);
        return file;
    }
};

void say_what_was_made(const Options& options, const std::vector<FieldGrid>& grids, const Session& session) {
    session.say(fmt::format("{}: {}x{} samples at {}, {} wavelength{}, {}", options.output, grids[0].plane.width,
                            grids[0].plane.height, format_length(grids[0].plane.pitch_x), grids.size(),
                            grids.size() == 1 ? "" : "s",
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
}

// Said, not refused: it shows only where things are deep.
void warn_of_parallax(const Session& session, const LightFieldSource& light_field, double pitch) {
    const double parallax = hologram::neighbouring_parallax(light_field, pitch);
    if (parallax <= hologram::max_parallax) return;
    const LightFieldGrid& grid = light_field.grid();
    const auto enough = [&](std::size_t count) {
        return std::ceil(static_cast<double>(count) * parallax / hologram::max_parallax);
    };
    session.say(
        fmt::format("neighbouring directions see the deepest things {:.1f} samples apart, and windows overlap "
                    "well up to {:.0f}; {}x{} directions would do",
                    parallax, hologram::max_parallax, enough(grid.directions_u), enough(grid.directions_v)));
}

// The field of a scene by a method that knows no light fields.
int straight_from_scene(const Options& options, const SceneMethod& method, const Session& session) {
    if (options.resume) throw Error(ErrorCode::usage, fmt::format("--resume: method {} cannot", method.name));
    if (options.render.fronts_only)
        throw Error(ErrorCode::usage, fmt::format("--cull-back-faces: method {} cannot", method.name));
    require_writable(options.output);
    const double width = options.render.size;
    const double height =
        width * static_cast<double>(options.render.hogels.rows) / static_cast<double>(options.render.hogels.columns);
    const double pitch = options.hologram.pitch;
    if (!(width >= pitch && height >= pitch && pitch > 0))
        throw Error(ErrorCode::usage, "--size, --pitch: the hologram must hold samples");
    std::vector<FieldGrid> grids;
    for (const double wavelength : options.hologram.wavelengths)
        grids.push_back({{static_cast<std::size_t>(std::lround(width / pitch)),
                          static_cast<std::size_t>(std::lround(height / pitch)), pitch, pitch, 0, 0},
                         wavelength});
    for (const FieldGrid& grid : grids) validate(grid, ErrorCode::usage, "hologram");
    RenderOptions render = options.render;
    render.cache_spacing = 0;  // in parts of a ray's width, and there are no rays
    const auto scene = shade_scene(session, load_scene(session, options.input, render), render);
    const auto sinks = create_hologram(options.output, grids, options.file(session));
    SceneHologramOptions how;
    how.seed = session.seed;
    how.spacing = options.hologram.spacing;
    how.planes = options.hologram.planes;
    if (!(how.spacing > 0)) throw Error(ErrorCode::usage, "--spacing: must be positive");
    Stage stage(session, "hologram");
    for (std::size_t i = 0; i < grids.size(); ++i) {
        how.channel = colour_of(grids[i].wavelength);
        copy(method.make(*scene, grids[i], how, stage.progress(i, grids.size())), *sinks[i]);
    }
    say_what_was_made(options, grids, session);
    return 0;
}

int hologram(Options options, const Session& session) {
    const InputKind kind = input_kind(options.input);
    if (const SceneMethod* method = find_scene_method(options.hologram.method)) {
        if (kind == InputKind::scene) return straight_from_scene(options, *method, session);
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is no scene, and method {} works on scenes", options.input, method->name));
    }
    if (kind == InputKind::hologram)
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is a hologram already; expected a light field or a scene", options.input));
    require_writable(options.output);
    HologramFileOptions file = options.file(session);
    std::vector<std::unique_ptr<LightFieldSource>> faces;
    if (kind == InputKind::scene) {
        const Scene scene = load_scene(session, options.input, options.render);
        if (options.resume) file.resume = describe_input(options.input, scene);
        faces = render_faces_on_demand(session, scene, options.render);
    } else {
        if (options.resume) file.resume = describe_input(options.input);
        faces = open_for_hologram(options.input, options.hologram);
    }
    require_holograms(grids_of(faces), options.hologram);
    if (kind == InputKind::scene)
        faces = render_for_reading(session, std::move(faces), options.hologram.wavelengths.size(),
                                   needs_depth(options.hologram));
    if (options.hologram.method == "olas") warn_of_parallax(session, *faces.front(), options.hologram.pitch);
    const auto sources = make_holograms(session, faces, options.hologram, 1);

    std::vector<FieldGrid> grids;
    for (const auto& source : sources) grids.push_back(source->grid());
    const auto sinks = create_hologram(options.output, grids, file);
    Stage stage(session, "hologram");
    for (std::size_t i = 0; i < sources.size(); ++i) copy(*sources[i], *sinks[i], 0, stage.progress(i, sources.size()));
    say_what_was_made(options, grids, session);
    return 0;
}

}  // namespace

void add_hologram(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel hologram pumpkin.h5 -o hologram.h5 --wavelength 633nm\n"
        "  hogel hologram pumpkin -o hologram.h5 --hogels 64x64 --size 4mm");
    command.positional("input", options->input, "X.h5|SCENE", "Light field, mesh file or built-in scene");
    command.text("-o,--output", options->output, "FILE", "Hologram to write, HDF5").required();
    command.flag("--half", options->half, "Store 16-bit floats rather than 32-bit ones");
    add_resume_flag(command, options->resume);
    add_scene_hologram_options(command, options->hologram);
    add_render_options(command, options->render);
    add_hemicube_option(command, options->render);
    command.work([options, &session] { return hologram(*options, session); });
}

}  // namespace hogel::cli
