// SPDX-License-Identifier: Apache-2.0
#include "hogel/files.h"

#include <algorithm>
#include <cctype>

#include "hogel/compress.h"
#include "hogel/io/finite.h"
#include "hogel/io/hdf5/files.h"
#include "hogel/io/summary.h"

namespace hogel {
namespace {

FileFormat picture_format(std::string name, std::vector<std::string> extensions, std::string text,
                          bool written = false) {
    FileFormat format{std::move(name), std::move(extensions), std::move(text), {FileKind::picture}, {}};
    if (written) format.writes = {FileKind::picture};
    return format;
}

FileFormat mesh_format(std::string name, std::vector<std::string> extensions, std::string text) {
    return {std::move(name), std::move(extensions), std::move(text), {FileKind::mesh}, {}};
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
    return FileKind::unknown;
}

}  // namespace

Table<FileFormat>& file_formats() {
    constexpr FileKind light_field = FileKind::light_field, hologram = FileKind::hologram;
    static Table<FileFormat> table(
        "file format",
        {
            {"hdf5",
             {".h5", ".hdf5"},
             "samples of light fields and holograms, for h5py and others",
             {light_field, hologram},
             {light_field, hologram}},
            {"hgl", {".hgl"}, "compressed light fields", {light_field}, {light_field}},
            {"npy", {".npy"}, "NumPy arrays: the samples of one field", {hologram}, {hologram}},
            {"mat", {".mat"}, "MATLAB arrays, versions 5 to 7.3: the samples of one field", {hologram}, {}},
            picture_format("exr", {".exr"}, "OpenEXR, linear half floats", true),
            picture_format("png", {".png"}, "PNG, 8 bits sRGB", true),
            picture_format("tiff", {".tif", ".tiff"}, "TIFF, 8 bits sRGB", true),
            picture_format("bmp", {".bmp"}, "Windows bitmap; written for the levels of a modulator alone", true),
            picture_format("jpeg", {".jpg", ".jpeg"}, "JPEG"),
            picture_format("gif", {".gif"}, "GIF"),
            picture_format("hdr", {".hdr"}, "Radiance RGBE"),
            picture_format("tga", {".tga"}, "Targa"),
            picture_format("webp", {".webp"}, "WebP"),
            mesh_format("gltf", {".gltf", ".glb"}, "glTF 2.0, with its materials and textures"),
            mesh_format("obj", {".obj"}, "Wavefront OBJ"),
            mesh_format("ply", {".ply"}, "Stanford polygons"),
            mesh_format("stl", {".stl"}, "stereolithography"),
            mesh_format("off", {".off"}, "Object File Format"),
            mesh_format("dae", {".dae"}, "COLLADA"),
            mesh_format("fbx", {".fbx"}, "Autodesk FBX"),
            mesh_format("3ds", {".3ds"}, "Autodesk 3DS"),
        });
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
