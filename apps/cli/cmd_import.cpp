// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string source;
    LightFieldOutput output;
    ImportParameters views;
};

void report_import(const Session& session, const std::string& source, const ImportedViews& views) {
    session.say(fmt::format("{}: {}", source, views.summary));
    for (const std::string& note : views.notes) session.say(fmt::format("{}: {}", source, note));
    if (!views.assumed.empty())
        session.say(fmt::format("{}: assumed, because neither the set nor an option says it: {}", source,
                                fmt::join(views.assumed, ", ")));
}

Result result_of(const ImportedViews& views) {
    return {{"layout", views.layout},
            {"views_across", views.columns},
            {"views_down", views.rows},
            {"bits", views.bits},
            {"transfer", transfer_names()[static_cast<std::size_t>(views.transfer)]},
            {"camera_spacing_m", views.spacing},
            {"camera_distance_m", views.distance},
            {"scale", views.scale},
            {"parallax", views.parallax},
            {"disparity_estimated", views.estimated}};
}

int write_hdf5(const Options& options, const ImportedViews& views, const LightFieldFileOptions& file,
               const Session& session) {
    LightFieldFileOptions with_metadata = file;
    with_metadata.metadata = with_history(file.metadata, to_metadata(views.light_field.provenance()));
    const LightFieldGrid& grid = views.light_field.grid();
    Stage stage(session, "importing");
    const auto sinks = create_light_field(options.output.file, {&grid, 1}, with_metadata);
    write_views(views.light_field, *sinks.front(), stage.progress());
    session.say(fmt::format("{}: {}x{} hogels of {}x{} directions, {}", options.output.file, grid.hogels_s,
                            grid.hogels_t, grid.directions_u, grid.directions_v,
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output.file)))));
    report_samples(session, options.output.file, result_of(views));
    return 0;
}

int import(Options& options, const Session& session) {
    options.output.require(options.source);
    options.views.views.with_depth = options.output.with_depth;
    ViewImportOptions view_options = options.views.options();
    view_options.spool = std::filesystem::absolute(options.output.file).parent_path();
    const ImportedViews views = [&] {
        Stage stage(session, "looking at the views");
        return import_views(options.source, view_options, stage.progress());
    }();
    report_import(session, options.source, views);
    options.views.resolve(views);
    LightFieldFileOptions file;
    // Half floats represent codes of up to 11 bits exactly.
    constexpr unsigned max_bits_of_half = 11;
    file.type = options.output.single || views.bits > max_bits_of_half ? SampleType::single : SampleType::half;
    check_plan(session, plan_import(views, view_options, file), "importing",
               options.output.compressed() ? "" : options.output.file);
    if (options.output.compressed()) {
        write_compressed(options.output, views.light_field, session);
        return 0;
    }
    options.output.single = file.type == SampleType::single;
    file.with_depth = options.output.with_depth;
    file.metadata = run_metadata(session);
    return write_hdf5(options, views, file, session);
}

}  // namespace

void add_import(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel import antinous -o antinous.h5 --size 40mm\n"
        "  hogel import chess -o chess.hgl --size 60mm --fov 12deg\n"
        "  hogel import head_qs8x6a0.75.png -o head.h5 --fov 40deg\n"
        "  hogel import lytro.mat -o lytro.h5 --size 40mm --fov 5deg\n"
        "  hogel import sockets -o sockets.h5 --projection orthographic --views 20x20");
    command.basics({"layout", "views", "column", "projection", "spacing", "fov", "disparity", "depth", "size", "sqnr"});
    command.positional("source", options->source, "SOURCE", "Folder of pictures, or a file: a quilt, an array, a film");
    add_light_field_output(command, options->output, "Store the depth of rays, by the disparity or depth of the set",
                           "Store 32-bit floats rather than 16-bit ones, as for pictures of more than 11 bits");
    command.look_up("depth")->acts_if([options] { return options->output.with_depth; });
    command.add_like_option();
    options->views.declare(command);
    command.work([options, &session] { return import(*options, session); });
}

}  // namespace hogel::cli
