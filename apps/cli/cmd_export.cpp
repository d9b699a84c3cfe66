// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "hogel/parameters.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "inputs.h"
#include "movie.h"
#include "outputs.h"
#include "run_record.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    ExportParameters views;
    LightFieldParameters render;
    bool force = false;

    // Returns the options of export_views(). A scene is rendered once: all views stay in memory.
    ViewExportOptions options(const LightField& light_field) const {
        ViewExportOptions asked = views.options();
        if (render.is_rendered) asked.memory = std::max(asked.memory, light_field.grid().samples() * sizeof(float));
        return asked;
    }
};

// Opens a light field or a set of views, or prepares the views of a scene, which are rendered when they are read.
LightField open_input(Options& options, const Session& session) {
    const InputKind kind = input_kind(options.input);
    if (kind == InputKind::hologram)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is neither a light field nor a scene", options.input));
    options.views.resolve(options.output);
    if (kind == InputKind::light_field) return open_light_field_or_views(options.input);
    options.views.set_cameras(options.render, options.output, *session.command);
    const Scene scene = load_scene(session, options.input, options.render);
    session.say(options.views.note_about_depth(scene, options.render));
    LightField rendered = render_light_field(session, scene, options.render);
    require_memory(session, rendered, options.render, scene);
    return rendered;
}

// Exports the middle row of cameras as a film, one frame per camera, from the left.
int export_walk(const Options& options, const LightField& light_field, const Session& session) {
    require_writable(options.output, {&options.input, 1});
    require_movie(options.output);
    const FrameFolder folder(options.output);
    const ViewExportOptions views = options.options(light_field);
    check_plan(session, plan_export(light_field, views), "exporting", options.output);
    Stage stage(session, "exporting");
    const ExportedViews exported = export_views(light_field, folder.path(), views, stage.progress());
    const std::uintmax_t bytes = write_film(options.output, folder, fmt::format("{:03}_%03d.png", exported.rows / 2),
                                            options.views.frame_rate, run_metadata(session), stage.progress());
    session.say(fmt::format("{}: {} views{}", options.output, exported.columns,
                            exported.rows > 1 ? fmt::format(" of the middle one of {} rows", exported.rows) : ""));
    session.result({{"file", options.output},
                    {"bytes", bytes},
                    {"layout", "film"},
                    {"views_across", exported.columns},
                    {"views_down", 1},
                    {"files", 1},
                    {"exposure", exported.exposure},
                    {"seconds", session.seconds()}});
    return 0;
}

int export_input(Options& options, const Session& session) {
    const LightField light_field = open_input(options, session);
    if (options.views.is_film) return export_walk(options, light_field, session);
    const ViewLayout layout = view_layouts().find(options.views.views.layout);
    std::unique_ptr<const OutputFolder> folder;
    if (layout.is_folder) {
        folder = std::make_unique<const OutputFolder>(options.output, options.force);
    } else {
        require_writable(options.output, {&options.input, 1});
    }
    ViewExportOptions views = options.options(light_field);
    views.metadata = run_metadata(session);
    check_plan(session, plan_export(light_field, views), "exporting", options.output);
    Stage stage(session, "exporting");
    const ExportedViews exported =
        with_parameter("layout", [&] { return export_views(light_field, options.output, views, stage.progress()); });
    const std::string device = options.views.device.empty() ? "" : " for " + options.views.device;
    session.say(fmt::format("{}: {}x{} views{}, {}{}, exposure {:.6g}", options.output, exported.columns, exported.rows,
                            device, exported.files.front().filename().string(),
                            exported.files.size() > 1 ? " to " + exported.files.back().filename().string() : "",
                            exported.exposure));
    for (const std::string& note : exported.notes) session.say(fmt::format("{}: {}", options.output, note));
    std::uintmax_t bytes = 0;
    for (const auto& file : exported.files) bytes += std::filesystem::file_size(file);
    session.result({{layout.is_folder ? "folder" : "file", options.output},
                    {"bytes", bytes},
                    {"layout", layout.name},
                    {"views_across", exported.columns},
                    {"views_down", exported.rows},
                    {"files", exported.files.size()},
                    {"exposure", exported.exposure},
                    {"seconds", session.seconds()}});
    return 0;
}

}  // namespace

void add_export(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel export bunny.ply -o bunny_qs8x6a0.75.png\n"
        "  hogel export antinous.h5 -o views --layout hci\n"
        "  hogel export antinous.h5 -o views --pictures ppm --bits 10\n"
        "  hogel export antinous.h5 -o views.npy\n"
        "  hogel export antinous.h5 -o walk.mp4");
    command.basics({"layout", "device", "exposure", "fov", "front", "rotate", "light", "samples", "pictures"});
    command.positional("input", options->input, "X.h5|X.hgl|SCENE", "Light field, mesh file or built-in scene");
    command
        .text("-o,--output", options->output, "FOLDER|FILE",
              "Folder for the views, or a file for single-file layouts; .mp4, .gif or .apng: a film of the "
              "middle row of views, by ffmpeg")
        .required()
        .never_acts();
    add_force_flag(command, options->force);
    command.add_like_option();
    options->views.declare(command);
    options->render.declare(command);
    options->render.declare_focal_plane(command);
    command.work([options, &session] { return export_input(*options, session); });
}

}  // namespace hogel::cli
