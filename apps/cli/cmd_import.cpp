// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string source;
    LightFieldOutput output;
    ViewOptions views;
    std::string projection, column, transfer, mirror = "none";
    double size = 0, distance = 0, spacing = 0, field_of_view = 0, disparity = 0;
    bool distance_given = false, spacing_given = false, field_given = false;
    Counts counts, middle;
    std::size_t densify = 1;
    double depth_scale = 0;
    bool estimate_disparity = false;
    bool is_estimated = false;

    bool has_columns() const { return views.layout == "rows-columns" || views.layout == "mat"; }
    bool has_depth_scale() const { return (densify > 1 || output.with_depth) && !is_estimated; }
};

ViewOptions view_options(const Options& options) {
    ViewOptions views = options.views;
    views.size = options.size;
    if (options.distance_given) views.distance = options.distance;
    if (options.spacing_given) views.spacing = options.spacing;
    if (options.field_given) views.field_of_view = options.field_of_view;
    if (!options.projection.empty()) views.orthographic = options.projection == "orthographic";
    if (!options.column.empty()) views.column_first = options.column == "first";
    views.transfer = transfer_named(options.transfer);
    views.columns = options.counts.columns;
    views.rows = options.counts.rows;
    views.mirror_columns = options.mirror == "columns" || options.mirror == "both";
    views.mirror_rows = options.mirror == "rows" || options.mirror == "both";
    views.disparity = options.disparity;
    views.densify = options.densify;
    views.estimate_disparity = options.estimate_disparity;
    views.with_depth = options.output.with_depth;
    views.depth_scale = options.depth_scale;
    views.middle_columns = options.middle.columns;
    views.middle_rows = options.middle.rows;
    return views;
}

// Sets the values that act on these views where they are not given, and what decides which act.
void resolve(Options& options, const ImportedViews& views) {
    options.views.layout = views.layout;
    options.transfer = transfer_names()[static_cast<std::size_t>(views.transfer)];
    options.size = views.light_field.grid().width();
    options.is_estimated = options.estimate_disparity = views.estimated;
}

void say_understood(const Session& session, const std::string& source, const ImportedViews& views) {
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
    ViewOptions view = view_options(options);
    view.spool = std::filesystem::absolute(options.output.file).parent_path();
    const ImportedViews views = [&] {
        Stage stage(session, "looking at the views");
        return import_views(options.source, view, stage.progress());
    }();
    say_understood(session, options.source, views);
    resolve(options, views);
    LightFieldFileOptions file;
    // Half floats hold codes of up to 11 bits so that they come back as they were.
    constexpr unsigned max_bits_of_half = 11;
    file.type = options.output.single || views.bits > max_bits_of_half ? SampleType::single : SampleType::half;
    state_plan(session, plan_import(views, view, file), "importing",
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

void add_geometry_options(Command& command, Options& options) {
    command.positive_length("--size", options.size, "Width of the hologram, to which the set is scaled (default: 20mm)")
        .no_default();
    command
        .positive_length("--distance", options.distance,
                         "From the cameras to the hologram (default: as the set says, else 300mm)")
        .no_default()
        .sets(options.distance_given);
    const Parameter& spacing =
        command
            .positive_length(
                "--spacing", options.spacing,
                "Between neighbouring cameras, at the hologram's scale (default: as the set says, else by --fov)")
            .no_default()
            .sets(options.spacing_given);
    command
        .angle("--fov", options.field_of_view,
               "Full angle that a row of views spans, where the set does not say it (default: 16deg)")
        .no_default()
        .sets(options.field_given)
        .excludes(spacing);
    command
        .number("--disparity", options.disparity, "PIXELS",
                "By how much the plane that is to be the hologram moves left from a view to the one on its right; the "
                "views are sheared and cropped (default: 0, the plane on which they agree)")
        .no_default();
}

void add_view_options(Command& command, Options& options) {
    std::string layouts;
    for (const ViewLayout& layout : view_layouts().rows()) layouts += fmt::format("\n{}: {}", layout.name, layout.text);
    command
        .text("--layout", options.views.layout, "NAME", "How they are stored (default: what is recognised)" + layouts)
        .no_default();
    command
        .counts("--views", options.counts,
                "Columns and rows of views, where one number counts them all (default: a square; of a film one row)")
        .no_default();
    command.counts("--middle", options.middle, "Take these columns and rows of views in the middle alone").no_default();
    command
        .choice("--column", options.column, {"first", "second"}, "first|second",
                "Which of the two numbers in the names of files, or axes of views, is the column (default: what the "
                "parallax says)")
        .no_default()
        .acts_if([&options] { return options.has_columns(); });
    command.choice("--mirror", options.mirror, {"none", "columns", "rows", "both"}, "WHICH",
                   "none, columns, rows or both: run the other way than the layout says");
    command
        .choice("--projection", options.projection, {"cameras", "orthographic"}, "NAME",
                "cameras, or orthographic views along one direction each (default: as the layout says)")
        .no_default();
    command
        .choice("--transfer", options.transfer, transfer_names(), "NAME",
                fmt::format("{}: the curve of the stored numbers (default: srgb, or linear for floating-point ones)",
                            fmt::join(transfer_names(), ", ")))
        .no_default();
}

void add_disparity_options(Command& command, Options& options) {
    command
        .count("--densify", options.densify,
               "Interpolate N - 1 views between neighbours, by the disparity or depth that comes with the set")
        .no_default();
    command
        .number("--depth-scale", options.depth_scale, "N",
                "How many of the whole numbers in PNG maps are a metre of depth, or a pixel of disparity: 1000 for "
                "millimetres; 0 is not known")
        .positive()
        .no_default()
        .acts_if([&options] { return options.has_depth_scale(); });
    command
        .flag("--estimate-disparity", options.estimate_disparity,
              "Where no map comes with the set, estimate the disparity from the views")
        .acts_if([&options] { return options.is_estimated; });
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
    command.group("Views");
    add_view_options(command, *options);
    command.group("Geometry");
    add_geometry_options(command, *options);
    command.group("Depth, and views between views");
    add_disparity_options(command, *options);
    command.work([options, &session] { return import(*options, session); });
}

}  // namespace hogel::cli
