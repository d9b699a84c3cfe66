// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/exchange/quilt_name.h"
#include "hogel/requests.h"
#include "hogel/table.h"
#include "hogel/units.h"

namespace hogel {
namespace {

// Returns the layout for the name of an output. Layouts of single files have extensions of their own.
std::string layout_for(const std::filesystem::path& output) {
    if (output.extension() == ".npy") return "npy";
    if (output.extension() == ".mat") return "mat";
    return output.has_extension() && output.stem().string().find("_qs") != std::string::npos ? "quilt" : "rows-columns";
}

// Return lines of help.
std::string list_of_layouts() {
    std::string lines;
    for (const ViewLayout& layout : view_layouts().rows())
        if (layout.create != nullptr) lines += fmt::format("\n{}: {}", layout.name, layout.text);
    return lines;
}
std::string list_of_displays() {
    std::string lines;
    for (const QuiltDisplay& display : quilt_displays().rows())
        lines += !display.fault.empty() ? fmt::format("\n{}: has a fault in its profile", display.name)
                                        : fmt::format("\n{}: {}x{} pixels, _qs{}x{}a{:.5g}{}", display.name,
                                                      display.width, display.height, display.columns, display.rows,
                                                      display.aspect, display.verified ? "" : " (not verified)");
    return lines;
}

// Returns the first display whose quilts have this name; empty: none.
std::string display_named(const exchange::QuiltTiling& tiling) {
    for (const QuiltDisplay& display : quilt_displays().rows())
        if (display.fault.empty() && display.columns == tiling.columns && display.rows == tiling.rows &&
            exchange::is_same_aspect(tiling.aspect, display.aspect))
            return display.name;
    return {};
}

// Throws unless a number of hogels or directions is that of the quilt or not given.
void require_own(const Parameters& given, const std::string& name, const Counts& value, const Counts& needed) {
    if (!given.given(name) || value == needed) return;
    throw Error(ErrorCode::usage, name,
                fmt::format("{}x{} were requested, but the quilt needs {}x{}; leave it out", value.columns, value.rows,
                            needed.columns, needed.rows));
}

// Square hogels at least as fine as the pixels of a display's tiles.
Counts hogels_for(const QuiltDisplay& display) {
    const auto width = static_cast<double>(display.tile_width()), height = static_cast<double>(display.tile_height());
    return {static_cast<std::size_t>(std::round(std::max(width, height * display.aspect))),
            static_cast<std::size_t>(std::round(std::max(height, width / display.aspect)))};
}

// As in the display maker's software, cameras see the height of the display at 14 degrees.
double depth_of_cameras(const LightFieldParameters& scene) {
    constexpr double height_angle = 14 * std::numbers::pi / 180;
    const double height =
        scene.size * static_cast<double>(scene.hogels.rows) / static_cast<double>(scene.hogels.columns);
    return -0.5 * height / std::tan(height_angle / 2);
}

// Depths in front of and behind the hologram between which points move by at most a number of pixels from a view to
// the next.
struct SharpDepths {
    double front = 0, behind = 0;
};

// A point at depth ζ moves by bζ/(D + ζ) on the hologram for cameras b apart at the distance D.
SharpDepths sharp_depths(double distance, double spacing, double movement) {
    const double q = movement / spacing;
    return {distance * q / (1 + q), q < 1 ? distance * q / (1 - q) : INFINITY};
}

// Pixels from a view to the next above which displays show double edges. Software for these displays (quiltwright)
// recommends 4 to 5; 8 are clearly visible.
constexpr double max_disparity = 5;

}  // namespace

double parse_exposure(const std::string& text) {
    if (text == "auto") return 0;
    const std::optional<double> exposure = parse_number(text);
    if (!exposure || !(*exposure > 0 && *exposure < 1e12))
        throw Error(ErrorCode::usage, "exposure", fmt::format("'{}' is neither auto nor a positive number", text));
    return *exposure;
}

ViewExportOptions ExportParameters::options() const {
    constexpr std::size_t too_many_bits = 99;  // export_views() refuses them
    ViewExportOptions asked = views;
    asked.bits = static_cast<unsigned>(std::min(bits, too_many_bits));
    asked.transfer = transfer_named(transfer);
    asked.exposure = parse_exposure(exposure.empty() ? "1" : exposure);
    if (!device.empty()) asked.display = find_quilt_display(device);
    return asked;
}

void ExportParameters::resolve(const std::filesystem::path& output) {
    if (!device.empty()) device = find_quilt_display(device).name;
    is_film = hogel::is_film(output);
    if (exposure.empty() && is_film) exposure = "auto";
    if (is_film) {
        views.layout = "rows-columns";
        views.format = "png";
        bits = 8;
        transfer = "srgb";
    } else {
        if (!layout_given) views.layout = device.empty() ? layout_for(output) : "quilt";
        if (view_layouts().find(views.layout).name == "quilt" && views.format.empty() && output.has_extension())
            views.format = output.extension().string().substr(1);
    }
    if (exposure.empty()) exposure = is_quilt() ? "auto" : "1";
    if (!device.empty() && !is_quilt())
        throw Error(ErrorCode::usage, "device", fmt::format("{} shows quilts; leave it out for other layouts", device));
}

void ExportParameters::set_cameras(LightFieldParameters& scene, const std::filesystem::path& output,
                                   const Parameters& given) {
    if (!is_quilt()) return;
    const std::optional<exchange::QuiltTiling> tiling = exchange::quilt_tiling(output);
    if (device.empty() && tiling) device = display_named(*tiling);
    if (device.empty() && !tiling)
        throw Error(
            ErrorCode::usage, "device",
            fmt::format("{}: the name of a quilt ends like _qs8x6a0.75.png: columns and rows of views, and their "
                        "aspect (width/height)",
                        output.string()));
    double field = 40 * std::numbers::pi / 180;
    Counts directions{1, 1}, hogels = scene.hogels;
    if (device.empty()) {
        directions.columns = tiling->columns * tiling->rows;
        if (!given.given("hogels") && tiling->aspect > 0)
            hogels.rows = static_cast<std::size_t>(
                std::max(1.0, std::round(static_cast<double>(hogels.columns) / tiling->aspect)));
    } else {
        const QuiltDisplay display = find_quilt_display(device);
        directions.columns = display.columns * display.rows;
        field = display.cone;
        hogels = hogels_for(display);
    }
    require_own(given, "hogels", scene.hogels, hogels);
    require_own(given, "directions", scene.directions, directions);
    scene.hogels = hogels;
    scene.directions = directions;
    if (!scene.field_of_view_given) scene.field_of_view.across = field;
    // Directions of a single row cover the same angle down as across.
    scene.field_of_view.down =
        2 * std::atan(std::tan(scene.field_of_view.across / 2) / static_cast<double>(directions.columns));
    if (!scene.focal_plane_given) scene.focal_plane = depth_of_cameras(scene);
    scene.focal_plane_given = true;
}

std::string ExportParameters::note_about_depth(const Scene& placed, const LightFieldParameters& scene) const {
    if (!is_quilt() || triangle_count(placed) == 0) return {};
    const LightFieldGrid grid = scene.grid();
    const double distance = -scene.focal_plane, spacing = distance * grid.step_u();
    const std::size_t pixels = device.empty() ? grid.hogels_s : find_quilt_display(device).tile_width();
    const double movement = max_disparity * grid.width() / static_cast<double>(pixels);
    const SharpDepths sharp = sharp_depths(distance, spacing, movement);
    const Bounds box = bounds(placed);
    double front = std::max(box.high.z, 0.0), behind = std::max(-box.low.z, 0.0);
    const auto length = [](double metres) { return format_length(std::stod(fmt::format("{:.3g}", metres))); };
    std::string note = fmt::format(
        "depths from {} to {} stay below {} pixels of disparity between neighbouring views; the scene spans {} to {}",
        length(-sharp.front), std::isfinite(sharp.behind) ? length(sharp.behind) : "infinity", max_disparity,
        length(-box.high.z), length(-box.low.z));
    if (front <= sharp.front && behind <= sharp.behind) return note;
    std::string advice;
    if (scene.scene.is_file && !scene.as_is) {
        // The same disparity at both ends: h/(D - h) = (d - h)/(D + d - h) for h of the depth d in front.
        const double depth = box.high.z - box.low.z;
        front = 0.5 * (distance + depth - std::hypot(distance, depth));
        behind = depth - front;
        advice = fmt::format("--front {:.2g}", front / depth);
    }
    const double widest = movement * std::min(front > 0 ? (distance - front) / front : INFINITY,
                                              behind > 0 ? (distance + behind) / behind : INFINITY);
    if (widest < spacing) {
        const double field = 2 * std::atan(0.5 * widest * static_cast<double>(grid.directions_u) / distance);
        advice += fmt::format("{}--fov {:.3g}deg", advice.empty() ? "" : " ", field * 180 / std::numbers::pi);
    }
    return note + fmt::format(": {} keeps it sharp", advice);
}

void ExportParameters::declare(Parameters& parameters) {
    const auto is_set = [this] { return !is_film; };
    parameters.group("Views");
    parameters
        .text("--layout", views.layout, "NAME",
              "Layout of the stored views; an ending .npy, .mat or _qs8x6a0.75.png of the output selects its own" +
                  list_of_layouts())
        .sets(layout_given)
        .acts_if(is_set);
    parameters
        .text("--device", device, "NAME",
              "Display of a quilt (default: of a scene, the first with the tiles of the name):" + list_of_displays())
        .no_default()
        .knows(quilt_display_names())
        .acts_if([this] { return is_quilt(); });
    parameters
        .choice("--pictures", views.format, {"png", "ppm", "pfm", "exr"}, "FORMAT",
                "Format: png, ppm (8 to 16 bits), pfm or exr (floating point; default: as imported, else png)")
        .no_default()
        .acts_if(is_set);
    parameters.count("--bits", bits, "Bits of whole numbers, 8 to 16; png: 8 or 16 (default: as imported, else 8)")
        .no_default()
        .acts_if(is_set);
    parameters
        .choice("--transfer", transfer, transfer_names(), "NAME",
                fmt::format("Transfer curve of the stored numbers: {} (default: as imported, else srgb, or linear for "
                            "floating point)",
                            fmt::join(transfer_names(), ", ")))
        .no_default()
        .acts_if(is_set);
    parameters
        .text("--exposure", exposure, "NUMBER|auto",
              "Factor for linear values (default: auto for quilts and films, except of imported views; else 1)")
        .no_default();
    parameters.number("--frame-rate", frame_rate, "NUMBER", "Views per second of a film").positive().acts_if([this] {
        return is_film;
    });
}

}  // namespace hogel
