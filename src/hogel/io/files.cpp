// SPDX-License-Identifier: Apache-2.0
#include "hogel/files.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "hogel/compress.h"
#include "hogel/image/picture_formats.h"
#include "hogel/io/finite.h"
#include "hogel/io/hdf5/files.h"
#include "hogel/io/summary.h"

namespace hogel {
namespace {

// The formats of pictures that this build has.
std::vector<FileFormat> picture_rows() {
    std::vector<FileFormat> rows;
    for (const image::PictureFormat& format : image::picture_formats()) {
        if (!format.built_in) continue;
        rows.push_back({format.name, format.extensions, format.text, {FileKind::picture}, {}});
        if (format.written_as_picture || format.written_as_levels) rows.back().writes = {FileKind::picture};
    }
    return rows;
}

std::vector<FileFormat> all_formats() {
    constexpr FileKind light_field = FileKind::light_field, hologram = FileKind::hologram;
    std::vector<FileFormat> rows{
        {"hdf5",
         {".h5", ".hdf5"},
         "samples of light fields and holograms, for h5py and others",
         {light_field, hologram},
         {light_field, hologram}},
        {"hgl", {".hgl"}, "compressed light fields", {light_field}, {light_field}},
        {"npy", {".npy"}, "NumPy arrays: the samples of one field", {hologram}, {hologram}},
        {"mat", {".mat"}, "MATLAB arrays, versions 5 to 7.3: the samples of one field", {hologram}, {}},
    };
    std::ranges::move(picture_rows(), std::back_inserter(rows));
    const auto add_mesh = [&](const char* name, std::vector<std::string> extensions, const char* text) {
        rows.push_back({name, std::move(extensions), text, {FileKind::mesh}, {}});
    };
    add_mesh("gltf", {".gltf", ".glb"}, "glTF 2.0, with its materials and textures");
    add_mesh("obj", {".obj"}, "Wavefront OBJ");
    add_mesh("ply", {".ply"}, "Stanford polygons");
    add_mesh("stl", {".stl"}, "stereolithography");
    add_mesh("off", {".off"}, "Object File Format");
    add_mesh("dae", {".dae"}, "COLLADA");
    add_mesh("fbx", {".fbx"}, "Autodesk FBX");
    add_mesh("3ds", {".3ds"}, "Autodesk 3DS");
    return rows;
}

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

// Only pictures and meshes are recognised by their names.
FileKind kind_by_extension(const std::filesystem::path& path) {
    const std::string extension = lower_case(path.extension().string());
    for (const FileFormat& format : file_formats().rows())
        if (std::ranges::count(format.extensions, extension) > 0)
            for (const FileKind kind : format.reads)
                if (kind == FileKind::picture || kind == FileKind::mesh) return kind;
    // A picture of a format that is not built in is known as such, so that its reader can say what is missing.
    return image::format_by_extension(path) != nullptr ? FileKind::picture : FileKind::unknown;
}

}  // namespace

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
