// SPDX-License-Identifier: Apache-2.0
#include "hogel/files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include "hogel/compress.h"
#include "hogel/core/lower_case.h"
#include "hogel/core/part.h"
#include "hogel/error.h"
#include "hogel/image/picture_formats.h"
#include "hogel/io/finite.h"
#include "hogel/io/hdf5/files.h"
#include "hogel/io/summary.h"

namespace hogel {
namespace {

// Returns the picture formats of this build.
std::vector<FileFormat> picture_rows() {
    std::vector<FileFormat> rows;
    for (const image::PictureFormat& format : image::picture_formats()) {
        if (!format.built_in) continue;
        rows.push_back({format.name, format.extensions, format.text, {}, {}});
        if (format.read) rows.back().reads = {FileKind::picture};
        if (format.written_as_picture || format.written_as_levels) rows.back().writes = {FileKind::picture};
    }
    return rows;
}

std::vector<FileFormat> mesh_rows() {
    std::vector<FileFormat> rows;
    const auto add = [&](const char* name, std::vector<std::string> extensions, const char* text) {
        rows.push_back({name, std::move(extensions), text, {FileKind::mesh}, {}});
    };
    add("gltf", {".gltf", ".glb"}, "glTF 2.0, with its materials and textures");
    add("obj", {".obj"}, "Wavefront OBJ");
    add("ply", {".ply"}, "Stanford polygons, and point clouds");
    add("xyz", {".xyz", ".pts", ".asc"}, "point clouds as text: x y z, and a colour or a normal");
    add("dat", {".dat"}, "point clouds of OpenHolo: index, x y z, phase, amplitude");
    add("stl", {".stl"}, "stereolithography");
    add("off", {".off"}, "Object File Format");
    add("dae", {".dae"}, "COLLADA");
    add("fbx", {".fbx"}, "Autodesk FBX");
    add("3ds", {".3ds"}, "Autodesk 3DS");
    add("layers", {".layers"}, "pictures at depths, as JSON");
    return rows;
}

std::vector<FileFormat> all_formats() {
    constexpr FileKind light_field = FileKind::light_field, hologram = FileKind::hologram;
    std::vector<FileFormat> rows{
        {"hgl", {".hgl"}, "compressed light fields", {light_field}, {light_field}},
        {"npy", {".npy"}, "NumPy arrays: the samples of fields", {hologram}, {hologram}},
        {"npz", {".npz"}, "NumPy archives: the samples of fields and their sampling", {hologram}, {hologram}},
        {"mat", {".mat"}, "MATLAB arrays, versions 5 to 7.3: the samples of fields", {hologram}, {hologram}},
        {"ohc", {".ohc"}, "OpenHolo complex fields", {hologram}, {}},
    };
    if (core::part("HDF5").built_in)
        rows.insert(rows.begin(), {"hdf5",
                                   {".h5", ".hdf5"},
                                   "samples of light fields and holograms, for h5py and others",
                                   {light_field, hologram},
                                   {light_field, hologram}});
    std::ranges::move(picture_rows(), std::back_inserter(rows));
    if (core::part("assimp").built_in) std::ranges::move(mesh_rows(), std::back_inserter(rows));
    return rows;
}

// Returns the format with this file extension, built in or not.
std::optional<FileFormat> format_of_name(const std::filesystem::path& path) {
    const std::string extension = core::lower_case_extension(path);
    if (extension.empty()) return std::nullopt;
    std::vector<FileFormat> rows = file_formats().rows();
    std::ranges::move(mesh_rows(), std::back_inserter(rows));
    for (const FileFormat& format : rows)
        if (std::ranges::count(format.extensions, extension) > 0) return format;
    if (const image::PictureFormat* format = image::format_by_extension(path))
        return FileFormat{format->name, format->extensions, format->text, {}, {}};
    // Formats that front ends write from the library's results.
    for (const char* other : {"mp4", "apng", "svg", "json", "html"})
        if (extension.substr(1) == other) return FileFormat{other, {extension}, "", {}, {}};
    return std::nullopt;
}

// Only pictures and meshes are recognised by name.
FileKind kind_by_extension(const std::filesystem::path& path) {
    const std::string extension = core::lower_case_extension(path);
    for (const FileFormat& format : file_formats().rows())
        if (std::ranges::count(format.extensions, extension) > 0)
            for (const FileKind kind : format.reads)
                if (kind == FileKind::picture || kind == FileKind::mesh) return kind;
    // Recognise formats that are not built in too, so that their reader can report the missing part.
    for (const FileFormat& format : mesh_rows())
        if (std::ranges::count(format.extensions, extension) > 0) return FileKind::mesh;
    return image::format_by_extension(path) != nullptr ? FileKind::picture : FileKind::unknown;
}

}  // namespace

bool io::hdf5::is_hdf5(const std::filesystem::path& path) {
    const auto fail = [&](const char* why) {
        throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': {}", path.string(), why));
    };
    std::error_code status;
    const std::filesystem::file_status status_of_file = std::filesystem::status(path, status);
    if (!std::filesystem::exists(status_of_file)) fail("no such file");
    if (std::filesystem::is_directory(status_of_file))
        fail("it is a folder without a set of views that is recognised; `hogel import` says why");
    if (!std::filesystem::is_regular_file(status_of_file)) fail("it is not a plain file");
    std::ifstream file(path, std::ios::binary);
    if (!file) fail("it cannot be opened");
    std::array<char, 8> start{};
    file.read(start.data(), start.size());
    return file && std::memcmp(start.data(), "\x89HDF\r\n\x1a\n", start.size()) == 0;
}

void require_hdf5(const std::filesystem::path& path) {
    core::require_part("HDF5", fmt::format("'{}', an HDF5 file", path.string()));
    require_name(path, "hdf5");
}

void require_name(const std::filesystem::path& path, std::string_view format) {
    const std::optional<FileFormat> named = format_of_name(path);
    if (!named || named->name == format) return;
    const FileFormat& expected = file_formats().find(format);
    throw Error(ErrorCode::usage,
                fmt::format("'{}' is named like a file of the format {}; expected a name that ends in {}",
                            path.string(), named->name, fmt::join(expected.extensions, " or ")));
}

void require_folder_name(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::optional<FileFormat> named = format_of_name(path);
    if (named && !std::filesystem::is_directory(path, ignored))
        throw Error(
            ErrorCode::usage,
            fmt::format("'{}' is named like a file of the format {}, but a folder is written; expected a name without "
                        "such an ending",
                        path.string(), named->name));
}

Table<FileFormat>& file_formats() {
    static Table<FileFormat> table("file format", all_formats());
    return table;
}

FileKind file_kind(const std::filesystem::path& path) {
    if (io::hdf5::is_hdf5(path)) return io::hdf5::kind_of(path);
    return is_stream(path) ? FileKind::light_field : kind_by_extension(path);
}

FileSummary summarize(const std::filesystem::path& path) {
    FileSummary summary;
    summary.kind = file_kind(path);
    summary.numbers.emplace_back("bytes", static_cast<double>(std::filesystem::file_size(path)));
    if (summary.kind != FileKind::light_field && summary.kind != FileKind::hologram) return summary;
    if (is_stream(path))
        io::describe(read_stream_info(path), summary);
    else
        io::hdf5::summarize(path, summary);
    return summary;
}

LightField open_light_field(const std::filesystem::path& path) {
    return is_stream(path) ? io::require_finite(open_stream(path), path) : io::hdf5::open_light_field(path);
}

}  // namespace hogel
