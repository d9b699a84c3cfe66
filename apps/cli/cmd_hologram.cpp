// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <span>

#include "commands.h"
#include "hogel/parameters.h"
#include "hogel/pattern.h"
#include "hogel/pipeline.h"
#include "hogel/scene_hologram.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    LightFieldParameters render;
    HologramParameters hologram;
    std::string device;
    bool half = false, resume = false;
    PartOption part;

    SampleType type() const { return half ? SampleType::half : SampleType::single; }
};

void report_hologram(const Options& options, const std::vector<FieldGrid>& grids, const Session& session) {
    session.say(fmt::format("{}: {}x{} samples at {}, {} wavelength{}, {}", options.output, grids[0].plane.width,
                            grids[0].plane.height, format_length(grids[0].plane.pitch_x), grids.size(),
                            grids.size() == 1 ? "" : "s",
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
    report_samples(session, options.output, {{"wavelengths_m", wavelengths_of(grids)}});
}

// Computes the field of a scene by a method without a light field.
int hologram_of_scene(Options& options, const SceneHologramMethod& method, const Session& session) {
    if (options.resume)
        throw Error(ErrorCode::usage, "resume", fmt::format("method {} cannot be resumed", method.name));
    if (options.part.part)
        throw Error(ErrorCode::usage, "part", fmt::format("method {} cannot compute parts", method.name));
    require_writable(options.output, {&options.input, 1});
    require_hdf5(options.output);
    const SceneHologramRequest request = options.hologram.scene_request(session.seed, options.render);
    LightFieldParameters& render = options.render;
    render.cache_spacing = 0;  // in ray widths; this method has no rays
    const auto scene = light_scene(session, load_scene(session, options.input, render), render);
    render.scene.has_background = false;  // only surfaces emit light
    options.hologram.resolve(method);
    Metadata scene_metadata = scene->provenance;
    std::erase_if(scene_metadata, [](const auto& entry) { return entry.first == "background"; });
    const auto sinks =
        create_hologram(options.output, request.grids,
                        {.type = options.type(), .metadata = with_history(run_metadata(session), scene_metadata)});
    Stage stage(session, "hologram");
    with_parameter("method", [&] {
        write_scene_holograms(method, *scene, request.grids, request.options, sinks, stage.progress());
    });
    report_hologram(options, request.grids, session);
    return 0;
}

int hologram(Options& options, const Session& session) {
    const InputKind kind = input_kind(options.input);
    HologramParameters& wanted = options.hologram;
    if (!options.device.empty()) wanted.fit(find_modulator(options.device), options.render, wanted.method == "olas");
    if (const SceneHologramMethod* method = scene_hologram_methods().look_up(options.hologram.method)) {
        if (kind == InputKind::scene) return hologram_of_scene(options, *method, session);
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is not a scene, but method {} requires one", options.input, method->name));
    }
    if (kind == InputKind::hologram)
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is a hologram already; expected a light field or a scene", options.input));
    require_writable(options.output, {&options.input, 1});
    require_hdf5(options.output);
    HologramFileOptions file;
    file.type = options.type();
    HologramRequest request = options.hologram.request(session.seed, 1);
    const auto check = [&](std::span<const LightFieldGrid> faces) {
        // The file that is opened may set the other members.
        request.pitch = options.hologram.request(faces, session.seed, 1).pitch;
        session.say(options.hologram.note_about_pitch(request, faces.front()));
        check_holograms(faces, request, kind == InputKind::scene);
        check_plan(session, plan_holograms(faces, request, file), "synthesising the hologram", options.output);
    };
    std::string part_input;
    const LightField light_field = [&] {
        if (kind == InputKind::light_field) {
            if (options.resume) file.resume = describe_input(options.input);
            // The date of the file may differ between machines.
            part_input = fmt::format("{}, {} bytes", options.input, std::filesystem::file_size(options.input));
            LightField opened = open_for_holograms(options.input, request, options.hologram.basis.empty());
            if (!options.device.empty())
                opened = fitted(session, opened, wanted, find_modulator(options.device), wanted.method == "olas");
            check(opened.grids());
            return opened;
        }
        check(options.render.request().grids());
        const Scene scene = load_scene(session, options.input, options.render);
        if (options.resume || options.part.part) part_input = describe_input(options.input, scene);
        if (options.resume) file.resume = part_input;
        const LightField rendered = render_light_field(session, scene, options.render);
        require_memory(session, rendered, options.render, scene);
        return prepare_for_reading(session, rendered, request.channels.size(), needs_depth(request.method));
    }();
    if (const std::string warning = warning_about(light_field, request); !warning.empty()) session.say(warning);
    options.hologram.resolve(request, light_field.grid());
    file.metadata = run_metadata(session);
    const auto holograms = make_holograms(light_field, request);
    if (options.part.part) {
        const std::string name = options.part.file_for(options.output);
        {
            Stage stage(session, "hologram");
            write_holograms_part(name, holograms, file, options.part.of(part_input), stage.progress());
        }
        report_part(session, name, *options.part.part);
        return 0;
    }
    {
        Stage stage(session, "hologram");
        write_holograms(options.output, holograms, file, stage.progress());
    }
    std::vector<FieldGrid> grids;
    for (const auto& hologram : holograms) grids.push_back(hologram->grid());
    report_hologram(options, grids, session);
    return 0;
}

}  // namespace

void add_hologram(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel hologram pumpkin.h5 -o hologram.h5 --wavelength 633nm\n"
        "  hogel hologram pumpkin -o hologram.h5 --hogels 64x64 --size 4mm\n"
        "  hogel hologram pumpkin -o hologram.h5 --device pluto --wavelength 532nm");
    command.basics(
        {"wavelength", "pitch", "method", "phase", "hogels", "directions", "size", "fov", "rotate", "light"});
    command.positional("input", options->input, "X.h5|SCENE", "Light field, picture, mesh file or built-in scene");
    command.text("-o,--output", options->output, "FILE", "Hologram to write, HDF5").required().never_acts();
    command.flag("--half", options->half, "Store 16-bit floats rather than 32-bit ones");
    add_resume_flag(command, options->resume);
    add_part_option(command, options->part);
    options->hologram.declare_with_scene_methods(command);
    command
        .text("--device", options->device, "NAME",
              "Modulator that will show the hologram: sets its pitch, and for a scene hogels, directions, size and "
              "field of view, where no option does")
        .knows(modulator_names())
        .no_default()
        .never_acts();
    options->render.declare(command);
    options->render.declare_hemicube(command);
    command.add_like_option();
    command.work([options, &session] { return hologram(*options, session); });
}

}  // namespace hogel::cli
