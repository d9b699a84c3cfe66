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
    std::string input, output, transfer;
    ViewExportOptions views;
    std::size_t bits = 0;
    double frame_rate = 24;
    bool force = false;
};

// The middle row of cameras as a film, one frame a camera from the left.
int export_walk(Options& options, const LightField& light_field, const Session& session) {
    require_writable(options.output, {&options.input, 1});
    require_movie(options.output);
    const FrameFolder folder(options.output);
    options.views.layout = "rows-columns";
    options.views.format = "png";
    options.views.bits = 8;
    options.views.transfer = Transfer::srgb;
    state_plan(session, plan_export(light_field, options.views), "exporting", options.output);
    Stage stage(session, "exporting");
    const ExportedViews exported = export_views(light_field, folder.path(), options.views, stage.progress());
    const std::uintmax_t bytes = write_film(options.output, folder, fmt::format("{:03}_%03d.png", exported.rows / 2),
                                            options.frame_rate, run_metadata(session), stage.progress());
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

// The layout that the name of an output asks for: those of files have endings of their own.
std::string layout_for(const std::filesystem::path& output, const std::string& otherwise) {
    if (output.extension() == ".npy") return "npy";
    if (output.extension() == ".mat") return "mat";
    return output.has_extension() && output.stem().string().find("_qs") != std::string::npos ? "quilt" : otherwise;
}

int export_light_field(Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a light field", options.input));
    const LightField light_field = open_light_field_or_views(options.input);
    if (is_film(options.output)) return export_walk(options, light_field, session);
    if (!session.command->given("--layout")) options.views.layout = layout_for(options.output, options.views.layout);
    const ViewLayout layout = view_layouts().find(options.views.layout);
    const std::filesystem::path output = options.output;
    std::unique_ptr<const OutputFolder> folder;
    if (layout.is_folder) {
        folder = std::make_unique<const OutputFolder>(options.output, options.force);
    } else {
        require_writable(options.output, {&options.input, 1});
    }
    options.views.bits = static_cast<unsigned>(std::min<std::size_t>(options.bits, 99));
    if (layout.name == "quilt" && options.views.format.empty() && output.has_extension())
        options.views.format = output.extension().string().substr(1);
    options.views.transfer = transfer_named(options.transfer);
    options.views.metadata = run_metadata(session);
    state_plan(session, plan_export(light_field, options.views), "exporting", options.output);
    Stage stage(session, "exporting");
    const ExportedViews exported = with_parameter(
        "layout", [&] { return export_views(light_field, options.output, options.views, stage.progress()); });
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
              "Folder for the views, or the file of layouts that are one; .mp4, .gif or .apng: a film of the "
              "middle row of views, by ffmpeg")
        .required()
        .never_acts();
    add_force_flag(command, options->force);
    command.add_like_option();
    const auto is_set = [options] { return !is_film(options->output); };
    command.group("Views");
    std::string layouts;
    for (const ViewLayout& layout : view_layouts().rows())
        if (layout.create != nullptr) layouts += fmt::format("\n{}: {}", layout.name, layout.text);
    command
        .text("--layout", options->views.layout, "NAME",
              "How they are stored (by the ending .npy, .mat or _qs8x6a0.75.png: as that says)" + layouts)
        .acts_if(is_set);
    command
        .choice("--pictures", options->views.format, {"png", "ppm", "pfm", "exr"}, "FORMAT",
                "png, ppm (8 to 16 bits), pfm or exr (floating-point numbers; default: as imported, else png)")
        .no_default()
        .acts_if(is_set);
    command.count("--bits", options->bits, "Of whole numbers, 8 to 16; png: 8 or 16 (default: as imported, else 8)")
        .no_default()
        .acts_if(is_set);
    command
        .choice("--transfer", options->transfer, transfer_names(), "NAME",
                fmt::format("{}: the curve of the stored numbers (default: as imported, else srgb, or linear for "
                            "floating-point ones)",
                            fmt::join(transfer_names(), ", ")))
        .no_default()
        .acts_if(is_set);
    command.number("--exposure", options->views.exposure, "NUMBER", "What linear values are multiplied by").positive();
    command.number("--frame-rate", options->frame_rate, "NUMBER", "Of films, views a second")
        .positive()
        .acts_if([is_set] { return !is_set(); });
    command.work([options, &session] { return export_light_field(*options, session); });
}

}  // namespace hogel::cli
