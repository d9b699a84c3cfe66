// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/geometry.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::exchange {
namespace {

// Default size, viewing distance and field of view, as for synthetic holograms (hogel/pipeline.h).
constexpr double assumed_size = 20e-3, assumed_distance = 300e-3, assumed_field = 16 * std::numbers::pi / 180;

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

double field_of_view(const ViewImportOptions& options) {
    const double field = options.field_of_view.value_or(assumed_field);
    if (!(field > 0 && field < std::numbers::pi))
        throw Error(ErrorCode::usage, "fov",
                    fmt::format("a field of view of {:.6g} degrees is impossible", degrees(field)));
    return field;
}

Shear shear_of(const ViewSet& set, const ViewImportOptions& options) {
    Shear shear;
    shear.dx = -options.disparity;
    shear.dy = -options.disparity * set.geometry.spacing_ratio;
    const auto crop = [](std::size_t pixels, double step, std::size_t views, double& first) {
        const double lost = std::abs(step) * static_cast<double>(views - 1);
        const double remaining = std::floor(static_cast<double>(pixels) - lost + 1e-9);
        if (!(remaining >= 1))
            throw Error(ErrorCode::usage, "disparity",
                        fmt::format("a disparity of {} leaves no pixel that all {} views show", std::abs(step), views));
        // Centre the cropped pictures in the hologram.
        const double middle =
            0.5 * (static_cast<double>(pixels) - remaining) - 0.5 * step * static_cast<double>(views - 1);
        first = std::abs(middle - std::round(middle)) < 1e-9 ? std::round(middle) : middle;
        return static_cast<std::size_t>(remaining);
    };
    shear.width = crop(set.width, shear.dx, set.columns, shear.x0);
    shear.height = crop(set.height, shear.dy, set.rows, shear.y0);
    const double shown = std::round(static_cast<double>(shear.height) * set.geometry.pixel_height);
    if (shown >= 1 && shown != static_cast<double>(shear.height)) {
        shear.step_y = static_cast<double>(shear.height) / shown;
        shear.y0 += 0.5 * shear.step_y - 0.5;
        shear.height = static_cast<std::size_t>(shown);
    }
    return shear;
}

// Returns half the range of n views' directions at steps of `step`. A single row gets the range of the columns.
double half_range(std::size_t views, double step, double other) {
    return views > 1 ? 0.5 * static_cast<double>(views) * step : other;
}

void place_orthographic(const ViewSet& set, const ViewImportOptions& options, Placement& placement) {
    if (options.distance || options.spacing)
        throw Error(ErrorCode::usage, "distance, spacing",
                    "orthographic views have directions instead of a distance and spacing of cameras");
    if (options.disparity != 0)
        throw Error(ErrorCode::usage, "disparity",
                    "orthographic views have no zero-parallax plane that a disparity could select");
    double step = set.geometry.spacing;
    if (options.field_of_view || step == 0) {
        const double field = field_of_view(options);
        if (!options.field_of_view)
            placement.assumed.push_back(fmt::format("a field of view of {:.6g} degrees", degrees(field)));
        step = 2 * std::tan(field / 2) / static_cast<double>(std::max(set.columns, std::size_t{2}));
    }
    const double half_u = half_range(set.columns, step, step);
    const double half_v = half_range(set.rows, step * set.geometry.spacing_ratio, half_u);
    placement.grid.view = Perspective{{half_u, half_v, 0, 0}, Face::front};
}

// Returns the distance from the cameras to the plane that becomes the hologram, in metres of the set; 0 if not stated.
double distance_in_set(const ViewGeometry& g, const ViewImportOptions& options) {
    if (g.distance == 0) return 0;
    if (options.disparity == 0 && std::isinf(g.distance))
        throw Error(ErrorCode::usage, "disparity",
                    "the cameras are parallel and their pictures not shifted: they agree at infinity; a "
                    "disparity says which plane is to be the hologram");
    if (options.disparity == 0) return g.distance;
    if (g.pixel_tangent == 0 || g.spacing == 0) return 0;
    const double inverse = 1 / g.distance + options.disparity * g.pixel_tangent / g.spacing;
    if (!(inverse > 0))
        throw Error(
            ErrorCode::usage, "disparity",
            fmt::format("a disparity of {} pixels corresponds to no plane in front of the cameras", options.disparity));
    return 1 / inverse;
}

void place_cameras(const ViewSet& set, const ViewImportOptions& options, Placement& placement) {
    const ViewGeometry& g = set.geometry;
    if (options.spacing && options.field_of_view)
        throw Error(ErrorCode::usage, "spacing, fov",
                    "camera spacing and field of view are both given; expected one of them");
    const double set_distance = distance_in_set(g, options);
    const auto columns = static_cast<double>(std::max(set.columns, set.rows));
    double& distance = placement.distance;
    if (options.distance) {
        distance = *options.distance;
    } else if (g.pixel_tangent > 0) {
        distance = placement.grid.pitch / g.pixel_tangent;
    } else {
        distance = assumed_distance;
        placement.assumed.push_back(fmt::format("a distance of {} from the cameras", format_length(distance)));
    }
    if (set_distance > 0) placement.scale = distance / set_distance;
    if (options.spacing) {
        placement.spacing = *options.spacing;
    } else if (g.spacing > 0 && set_distance > 0 && !options.field_of_view) {
        placement.spacing = g.spacing * placement.scale;
    } else {
        const double field = field_of_view(options);
        if (!options.field_of_view)
            placement.assumed.push_back(fmt::format("a field of view of {:.6g} degrees", degrees(field)));
        placement.spacing = 2 * std::tan(field / 2) * distance / columns;
    }
    placement.spacing_y = placement.spacing * g.spacing_ratio;
    const double half_u = half_range(set.columns, placement.spacing / distance, placement.spacing / distance);
    // Scale the set's tangents to the requested distance.
    const double stretch = g.pixel_tangent > 0 ? placement.grid.pitch / g.pixel_tangent / distance : 1;
    placement.grid.view = FocalPlane{{half_u, half_range(set.rows, placement.spacing_y / distance, half_u),
                                      g.center_u * stretch, g.center_v * stretch},
                                     -distance};
}

}  // namespace

Placement place(const ViewSet& set, const ViewImportOptions& options) {
    Placement placement;
    placement.shear = shear_of(set, options);
    const double size = options.size > 0 ? options.size : assumed_size;
    if (!(options.size > 0)) placement.assumed.push_back(fmt::format("a width of {}", format_length(size)));
    LightFieldGrid& grid = placement.grid;
    grid.hogels_s = placement.shear.width;
    grid.hogels_t = placement.shear.height;
    grid.pitch = size / static_cast<double>(grid.hogels_s);
    grid.directions_u = set.columns;
    grid.directions_v = set.rows;
    grid.channels = set.channels;
    if (set.geometry.orthographic)
        place_orthographic(set, options, placement);
    else
        place_cameras(set, options, placement);
    // Without options, an invalid geometry is the set's own error.
    if (options.size > 0 || options.distance || options.spacing || options.field_of_view || options.disparity != 0)
        validate(grid, ErrorCode::usage, set.layout);
    else
        validate(grid, ErrorCode::bad_input, set.pictures->name(0, 0));
    return placement;
}

std::string describe(const ViewSet& set, const Placement& placement, double parallax) {
    std::string views;
    if (set.geometry.orthographic)
        views = fmt::format("{}x{} orthographic views", set.columns, set.rows);
    else if (placement.scale > 0)
        views = fmt::format("{}x{} cameras {} apart, focused at {}", set.columns, set.rows,
                            format_length(placement.spacing / placement.scale),
                            format_length(placement.distance / placement.scale));
    else
        views = fmt::format("{}x{} cameras {} apart at {}", set.columns, set.rows, format_length(placement.spacing),
                            format_length(placement.distance));
    const LightFieldGrid& grid = placement.grid;
    const std::string cropped = grid.hogels_s == set.width && grid.hogels_t == set.height
                                    ? ""
                                    : fmt::format(" of {}x{} pixels", set.width, set.height);
    const std::string scaled =
        placement.scale > 0 && !set.geometry.orthographic ? fmt::format(" at 1:{:.4g}", 1 / placement.scale) : "";
    return fmt::format(
        "{}{} become {}x{} hogels of {}{}, {:.3g} degrees wide, {:.2g} samples of parallax from view to view", views,
        cropped, grid.hogels_s, grid.hogels_t, format_length(grid.pitch), scaled, degrees(2 * std::atan(grid.half_u())),
        parallax);
}

}  // namespace hogel::exchange
