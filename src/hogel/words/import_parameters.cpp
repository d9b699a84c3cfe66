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
        .text("--layout", options.views.layout, "NAME",
              "Layout of the stored views (default: recognised from the files)" + layouts)
        .no_default();
    parameters
        .counts("--views", options.counts,
                "Columns and rows of views that are numbered consecutively (default: a square; for a film one row)")
        .no_default();
    parameters.counts("--middle", options.middle, "Import only this many columns and rows of views, in the middle")
        .no_default();
    parameters
        .choice("--column", options.column, {"first", "second"}, "first|second",
                "Which of the two numbers in file names, or of the two axes of views, is the column (default: found "
                "from the parallax)")
        .no_default()
        .acts_if([&views = options.views] { return views.layout == "rows-columns" || views.layout == "mat"; });
    parameters.choice("--mirror", options.mirror, {"none", "columns", "rows", "both"}, "WHICH",
                      "Reverse the order of columns, rows or both (default: none, the order of the layout)");
    parameters
        .choice("--projection", options.projection, {"cameras", "orthographic"}, "NAME",
                "Views of cameras, or orthographic: each along one direction (default: from the layout)")
        .no_default();
    parameters
        .choice("--transfer", options.transfer, transfer_names(), "NAME",
                fmt::format("Transfer curve of the stored numbers: {} (default: srgb, or linear for floating point)",
                            fmt::join(transfer_names(), ", ")))
        .no_default();
}

void declare_geometry(Parameters& parameters, ViewImportOptions& views) {
    parameters.group("Geometry");
    parameters.positive_length("--size", views.size, "Width of the hologram; the set is scaled to it (default: 20mm)")
        .no_default();
    parameters.positive_length("--distance", views.distance,
                               "Distance from the cameras to the hologram (default: from the set, else 300mm)");
    parameters.positive_length(
        "--spacing", views.spacing,
        "Distance of neighbouring cameras, at the hologram's scale (default: from the set, else from --fov)");
    parameters
        .angle("--fov", views.field_of_view,
               "Full angle spanned by a row of views, if the set does not contain it (default: 16deg)")
        .excludes("--spacing");
    parameters
        .number("--disparity", views.disparity, "PIXELS",
                "Disparity of the hologram plane: its shift to the left from a view to the next on the right; the "
                "views are sheared and cropped (default: 0, the plane without disparity)")
        .no_default();
}

void declare_disparity(Parameters& parameters, ViewImportOptions& views) {
    parameters.group("Depth and interpolated views");
    parameters
        .count("--densify", views.densify,
               "Interpolate N - 1 views between neighbours, from the disparity or depth of the set")
        .no_default();
    parameters
        .number("--depth-scale", views.depth_scale, "N",
                "Value in PNG maps for one metre of depth, or one pixel of disparity: 1000 for millimetres; the value "
                "0 means unknown")
        .positive()
        .no_default()
        .acts_if([&views] { return (views.densify > 1 || views.with_depth) && !views.estimate_disparity; });
    parameters
        .flag("--estimate-disparity", views.estimate_disparity,
              "Estimate the disparity from the views, if the set has no map")
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
