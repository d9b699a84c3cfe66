// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hogel/requests.h"
#include "hogel/table.h"

namespace hogel {
namespace {

void declare_views(Parameters& parameters, ImportParameters& options) {
    parameters.group("Views");
    std::string layouts;
    for (const ViewLayout& layout : view_layouts().rows()) layouts += fmt::format("\n{}: {}", layout.name, layout.text);
    parameters
        .text("--layout", options.views.layout, "NAME", "How they are stored (default: what is recognised)" + layouts)
        .no_default();
    parameters
        .counts("--views", options.counts,
                "Columns and rows of views, where one number counts them all (default: a square; of a film one row)")
        .no_default();
    parameters.counts("--middle", options.middle, "Take these columns and rows of views in the middle alone")
        .no_default();
    parameters
        .choice("--column", options.column, {"first", "second"}, "first|second",
                "Which of the two numbers in the names of files, or axes of views, is the column (default: what the "
                "parallax says)")
        .no_default()
        .acts_if([&views = options.views] { return views.layout == "rows-columns" || views.layout == "mat"; });
    parameters.choice("--mirror", options.mirror, {"none", "columns", "rows", "both"}, "WHICH",
                      "none, columns, rows or both: run the other way than the layout says");
    parameters
        .choice("--projection", options.projection, {"cameras", "orthographic"}, "NAME",
                "cameras, or orthographic views along one direction each (default: as the layout says)")
        .no_default();
    parameters
        .choice("--transfer", options.transfer, transfer_names(), "NAME",
                fmt::format("{}: the curve of the stored numbers (default: srgb, or linear for floating-point ones)",
                            fmt::join(transfer_names(), ", ")))
        .no_default();
}

void declare_geometry(Parameters& parameters, ViewImportOptions& views) {
    parameters.group("Geometry");
    parameters
        .positive_length("--size", views.size, "Width of the hologram, to which the set is scaled (default: 20mm)")
        .no_default();
    parameters.positive_length("--distance", views.distance,
                               "From the cameras to the hologram (default: as the set says, else 300mm)");
    parameters.positive_length(
        "--spacing", views.spacing,
        "Between neighbouring cameras, at the hologram's scale (default: as the set says, else by --fov)");
    parameters
        .angle("--fov", views.field_of_view,
               "Full angle that a row of views spans, where the set does not say it (default: 16deg)")
        .excludes("--spacing");
    parameters
        .number("--disparity", views.disparity, "PIXELS",
                "By how much the plane that is to be the hologram moves left from a view to the one on its right; the "
                "views are sheared and cropped (default: 0, the plane on which they agree)")
        .no_default();
}

void declare_disparity(Parameters& parameters, ViewImportOptions& views) {
    parameters.group("Depth, and views between views");
    parameters
        .count("--densify", views.densify,
               "Interpolate N - 1 views between neighbours, by the disparity or depth that comes with the set")
        .no_default();
    parameters
        .number("--depth-scale", views.depth_scale, "N",
                "How many of the whole numbers in PNG maps are a metre of depth, or a pixel of disparity: 1000 for "
                "millimetres; 0 is not known")
        .positive()
        .no_default()
        .acts_if([&views] { return (views.densify > 1 || views.with_depth) && !views.estimate_disparity; });
    parameters
        .flag("--estimate-disparity", views.estimate_disparity,
              "Where no map comes with the set, estimate the disparity from the views")
        .acts_if([&views] { return views.estimate_disparity; });
}

}  // namespace

ViewImportOptions ImportParameters::options() const {
    ViewImportOptions asked = views;
    if (!projection.empty()) asked.orthographic = projection == "orthographic";
    if (!column.empty()) asked.column_first = column == "first";
    asked.transfer = transfer_named(transfer);
    asked.columns = counts.columns;
    asked.rows = counts.rows;
    asked.middle_columns = middle.columns;
    asked.middle_rows = middle.rows;
    asked.mirror_columns = mirror == "columns" || mirror == "both";
    asked.mirror_rows = mirror == "rows" || mirror == "both";
    return asked;
}

void ImportParameters::resolve(const ImportedViews& imported) {
    views.layout = imported.layout;
    transfer = transfer_names()[static_cast<std::size_t>(imported.transfer)];
    views.size = imported.light_field.grid().width();
    views.estimate_disparity = imported.estimated;
}

void ImportParameters::declare(Parameters& parameters) {
    declare_views(parameters, *this);
    declare_geometry(parameters, views);
    declare_disparity(parameters, views);
}

}  // namespace hogel
