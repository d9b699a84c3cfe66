// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string_view>

#include "hogel/compress.h"
#include "hogel/files.h"
#include "hogel/io/hdf5/grids.h"

namespace hogel {

using namespace io;
using namespace io::hdf5;

namespace {

constexpr std::array pictures{".png", ".exr", ".tif", ".tiff", ".jpg", ".jpeg",
                              ".bmp", ".gif", ".hdr", ".tga",  ".webp"};
constexpr std::array meshes{".gltf", ".glb", ".obj", ".ply", ".stl", ".off", ".dae", ".fbx", ".3ds"};

FileKind kind_by_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (std::ranges::find(pictures, extension) != pictures.end()) return FileKind::picture;
    if (std::ranges::find(meshes, extension) != meshes.end()) return FileKind::mesh;
    return FileKind::unknown;
}

// The angle between the first and the last of the directions.
double degrees_across(bool sines, double center, double half) {
    const auto angle = [&](double at) { return sines ? std::asin(std::clamp(at, -1.0, 1.0)) : std::atan(at); };
    return (angle(center + half) - angle(center - half)) * 180 / std::numbers::pi;
}

void describe(const LightFieldGrid& grid, FileSummary& summary) {
    const bool sines = !grid.is_perspective();
    summary.numbers.insert(summary.numbers.end(),
                           {{"hogels_s", static_cast<double>(grid.hogels_s)},
                            {"hogels_t", static_cast<double>(grid.hogels_t)},
                            {"hogel_pitch_m", grid.pitch},
                            {"width_m", static_cast<double>(grid.hogels_s) * grid.pitch},
                            {"height_m", static_cast<double>(grid.hogels_t) * grid.pitch},
                            {"directions_u", static_cast<double>(grid.directions_u)},
                            {"directions_v", static_cast<double>(grid.directions_v)},
                            {sines ? "sine_half_u" : "tan_half_u", grid.half_u()},
                            {sines ? "sine_half_v" : "tan_half_v", grid.half_v()},
                            {"center_u", grid.center_u()},
                            {"center_v", grid.center_v()},
                            {"field_of_view_u_deg", degrees_across(sines, grid.center_u(), grid.half_u())},
                            {"field_of_view_v_deg", degrees_across(sines, grid.center_v(), grid.half_v())},
                            {"channels", static_cast<double>(grid.channels)}});
}

// Which faces there are, and how the sides are sampled.
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

const char* name_of(hdf5::Element element) { return element == hdf5::Element::half ? "half" : "single"; }

FileKind kind_of(hid_t file, const std::filesystem::path& path) {
    if (!hdf5::has_attribute(file, "format", path)) return FileKind::unknown;
    const std::string format = hdf5::read_text(file, "format", path);
    if (format == hdf5::light_field_format) return FileKind::light_field;
    return format == hdf5::hologram_format ? FileKind::hologram : FileKind::unknown;
}

}  // namespace

FileKind file_kind(const std::filesystem::path& path) {
    if (!hdf5::is_hdf5(path)) return is_stream(path) ? FileKind::light_field : kind_by_extension(path);
    const hdf5::Session session;
    const hdf5::Handle file = hdf5::open_file(path);
    return kind_of(file.id(), path);
}

FileSummary summarize(const std::filesystem::path& path) {
    FileSummary summary;
    summary.kind = file_kind(path);
    summary.numbers.emplace_back("bytes", static_cast<double>(std::filesystem::file_size(path)));
    if (summary.kind != FileKind::light_field && summary.kind != FileKind::hologram) return summary;
    if (is_stream(path)) {
        describe(read_stream_info(path), summary);
        return summary;
    }
    const hdf5::Session session;
    const hdf5::Handle file = hdf5::open_file(path);
    summary.text.emplace_back("format", hdf5::read_text(file.id(), "format", path));
    summary.numbers.emplace_back("format_version",
                                 static_cast<double>(hdf5::read_count(file.id(), "format_version", path)));
    if (summary.kind == FileKind::light_field) {
        const std::vector<LightFieldGrid> grids = read_light_field_grids(file.id(), path);
        const LightFieldGrid& grid = grids.front();
        describe(grid, summary);
        describe_faces(grids, summary);
        const auto raw = std::make_shared<core::RawFile>(path, core::RawFile::Mode::read, path);
        const std::vector<std::size_t> shape{grid.channels, grid.hogels_t, grid.hogels_s, grid.directions_v,
                                             grid.directions_u};
        const DatasetReader radiance(file.id(), "radiance", shape, false, raw);
        summary.text.emplace_back("samples", name_of(radiance.element()));
        summary.text.emplace_back("depth", hdf5::has_member(file.id(), "depth", path) ? "yes" : "no");
    } else {
        const std::vector<FieldGrid> grids = read_hologram_grids(file.id(), path);
        summary.numbers.emplace_back("fields", static_cast<double>(grids.size()));
        for (std::size_t i = 0; i < grids.size(); ++i) describe(grids[i], i, summary);
        const auto raw = std::make_shared<core::RawFile>(path, core::RawFile::Mode::read, path);
        summary.text.emplace_back("samples", name_of(samples_of_field(file.id(), 0, grids[0], raw).element()));
    }
    for (auto& word : hdf5::read_metadata(file.id(), path)) summary.text.push_back(std::move(word));
    return summary;
}

}  // namespace hogel
