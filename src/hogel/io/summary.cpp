// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "hogel/io/summary.h"

namespace hogel::io {

namespace {

// Returns the angle in degrees between the outer edges of the directions' cells.
double degrees_across(bool sines, double center, double half) {
    const auto angle = [&](double value) { return sines ? std::asin(std::clamp(value, -1.0, 1.0)) : std::atan(value); };
    return (angle(center + half) - angle(center - half)) * 180 / std::numbers::pi;
}

// Returns the quantity of the direction range, as in the attribute names of files.
std::string_view half_name(const LightFieldGrid& grid) {
    return grid.has_frequencies() ? "sine_half" : grid.focal_plane() ? "focal_half" : "tan_half";
}

}  // namespace

void describe(const LightFieldGrid& grid, FileSummary& summary) {
    const bool sines = grid.has_frequencies();
    summary.numbers.insert(summary.numbers.end(),
                           {{"hogels_s", static_cast<double>(grid.hogels_s)},
                            {"hogels_t", static_cast<double>(grid.hogels_t)},
                            {"hogel_pitch_m", grid.pitch},
                            {"width_m", static_cast<double>(grid.hogels_s) * grid.pitch},
                            {"height_m", static_cast<double>(grid.hogels_t) * grid.pitch},
                            {"directions_u", static_cast<double>(grid.directions_u)},
                            {"directions_v", static_cast<double>(grid.directions_v)},
                            {fmt::format("{}_u", half_name(grid)), grid.half_u()},
                            {fmt::format("{}_v", half_name(grid)), grid.half_v()},
                            {"center_u", grid.center_u()},
                            {"center_v", grid.center_v()},
                            {"field_of_view_u_deg", degrees_across(sines, grid.center_u(), grid.half_u())},
                            {"field_of_view_v_deg", degrees_across(sines, grid.center_v(), grid.half_v())},
                            {"channels", static_cast<double>(grid.channels)}});
    if (const FocalPlane* plane = grid.focal_plane()) summary.numbers.emplace_back("focal_plane_m", plane->depth);
}

void describe_faces(const std::vector<LightFieldGrid>& grids, FileSummary& summary) {
    std::string faces;
    for (const LightFieldGrid& face : grids) {
        if (!faces.empty()) faces += ' ';
        faces += face_name(face.face());
        if (face.face() == Face::front) continue;
        summary.numbers.emplace_back(fmt::format("{}_directions_u", face_name(face.face())),
                                     static_cast<double>(face.directions_u));
        summary.numbers.emplace_back(fmt::format("{}_directions_v", face_name(face.face())),
                                     static_cast<double>(face.directions_v));
    }
    summary.text.emplace_back("faces", faces);
}

void describe(const FieldGrid& grid, std::size_t index, FileSummary& summary) {
    const Grid& plane = grid.plane;
    const auto add = [&](std::string_view name, double value) {
        summary.numbers.emplace_back(fmt::format("field{}_{}", index, name), value);
    };
    add("wavelength_m", grid.wavelength);
    add("samples_x", static_cast<double>(plane.width));
    add("samples_y", static_cast<double>(plane.height));
    add("pitch_x_m", plane.pitch_x);
    add("pitch_y_m", plane.pitch_y);
    add("width_m", plane.size_x());
    add("height_m", plane.size_y());
    add("center_x_m", plane.center_x);
    add("center_y_m", plane.center_y);
}

void describe(const StreamInfo& info, FileSummary& summary) {
    const LightFieldGrid& grid = info.grid;
    double pixels = 0;
    for (const LightFieldGrid& face : info.faces())
        pixels += static_cast<double>(face.directions()) * static_cast<double>(face.hogels());
    describe(grid, summary);
    if (!info.sides.empty()) {
        describe_faces(info.faces(), summary);
        summary.text.emplace_back("hemicube", info.layout == StreamLayout::unfolded ? "unfolded" : "faces");
    }
    if (info.layout == StreamLayout::stacked) summary.text.emplace_back("layout", "stacked");
    summary.text.insert(summary.text.end(), {{"format", "hogel compressed light field"}, {"coder", info.method.coder}});
    if (!info.method.transform.empty()) summary.text.emplace_back("transform", info.method.transform);
    if (info.tone)
        summary.text.emplace_back("tone_curve", fmt::format("{:.2f} decades of luminance in {:.2f}", info.tone->decades,
                                                            info.tone->mapped_decades));
    if (info.chrominance != 1)
        summary.text.emplace_back("chrominance", fmt::format("{:.9g} times as coarse", info.chrominance));
    if (info.layer_ends.size() > 1) {
        summary.text.emplace_back("layers", fmt::format("{} of {}", info.layers_there, info.layer_ends.size()));
        summary.text.emplace_back("layers_end_at", fmt::format("{}", fmt::join(info.layer_ends, " ")));
    }
    summary.text.emplace_back("depth", info.depth.bytes == 0 ? "no" : info.depth_there ? "yes" : "cut off");
    if (info.depth.bytes > 0)
        summary.numbers.insert(summary.numbers.end(), {{"depth_bytes", static_cast<double>(info.depth.bytes)},
                                                       {"depth_error_m", info.depth.error}});
    summary.numbers.insert(
        summary.numbers.end(),
        {{"format_version", static_cast<double>(info.version)},
         {"tile_s", static_cast<double>(info.tile.ns)},
         {"tile_t", static_cast<double>(info.tile.nt)},
         {"pixels_per_bit", pixels / (8 * static_cast<double>(info.layer_ends.back() + info.depth.bytes))}});
    if (info.filler > 0) summary.numbers.emplace_back("filler_bytes", static_cast<double>(info.filler));
    summary.text.insert(summary.text.end(), info.metadata.begin(), info.metadata.end());
}

}  // namespace hogel::io
