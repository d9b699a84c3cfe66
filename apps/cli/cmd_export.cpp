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
    bool force = false;
};

// Exports the middle row of cameras as a film, one frame per camera, from the left.
int export_walk(const Options& options, const LightField& light_field, const Session& session) {
    require_writable(options.output, {&options.input, 1});
    require_movie(options.output);
    const FrameFolder folder(options.output);
    const ViewExportOptions views = options.views.options();
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
                    {"seconds", session.seconds()}});
    return 0;
}

int export_light_field(Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a light field", options.input));
    const LightField light_field = open_light_field_or_views(options.input);
    options.views.resolve(options.output);
    if (options.views.is_film) return export_walk(options, light_field, session);
    const ViewLayout layout = view_layouts().find(options.views.views.layout);
    std::unique_ptr<const OutputFolder> folder;
    if (layout.is_folder) {
        folder = std::make_unique<const OutputFolder>(options.output, options.force);
    } else {
        require_writable(options.output, {&options.input, 1});
    }
    ViewExportOptions views = options.views.options();
    views.metadata = run_metadata(session);
    check_plan(session, plan_export(light_field, views), "exporting", options.output);
    Stage stage(session, "exporting");
    const ExportedViews exported =
        with_parameter("layout", [&] { return export_views(light_field, options.output, views, stage.progress()); });
    session.say(fmt::format("{}: {}x{} views, {}{}", options.output, exported.columns, exported.rows,
                            exported.files.front().filename().string(),
                            exported.files.size() > 1 ? " to " + exported.files.back().filename().string() : ""));
    for (const std::string& note : exported.notes) session.say(fmt::format("{}: {}", options.output, note));
    std::uintmax_t bytes = 0;
    for (const auto& file : exported.files) bytes += std::filesystem::file_size(file);
    session.result({{layout.is_folder ? "folder" : "file", options.output},
                    {"bytes", bytes},
                    {"layout", layout.name},
                    {"views_across", exported.columns},
                    {"views_down", exported.rows},
                    {"files", exported.files.size()},
                    {"seconds", session.seconds()}});
    return 0;
}

}  // namespace

void add_export(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel export antinous.h5 -o views --layout hci\n"
        "  hogel export antinous.h5 -o views --pictures ppm --bits 10\n"
        "  hogel export antinous.h5 -o views.npy\n"
        "  hogel export antinous.h5 -o walk.mp4");
    command.positional("input", options->input, "X.h5|X.hgl", "Light field");
    command
        .text("-o,--output", options->output, "FOLDER|FILE",
              "Folder for the views, or a file for single-file layouts; .mp4, .gif or .apng: a film of the "
              "middle row of views, by ffmpeg")
        .required()
        .never_acts();
    add_force_flag(command, options->force);
    command.add_like_option();
    options->views.declare(command);
    command.work([options, &session] { return export_light_field(*options, session); });
}

}  // namespace hogel::cli
