// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/picture_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "hogel/error.h"

namespace hogel::image {
namespace {

#ifdef HOGEL_TIFF
constexpr bool has_tiff = true;
#else
constexpr bool has_tiff = false;
#endif
#ifdef HOGEL_WEBP
constexpr bool has_webp = true;
#else
constexpr bool has_webp = false;
#endif

}  // namespace

const std::vector<PictureFormat>& picture_formats() {
    static const std::vector<PictureFormat> formats{
        {"png", "PNG", {".png"}, "PNG, 8 bits sRGB", true, true, true},
        {"exr", "OpenEXR", {".exr"}, "OpenEXR, linear half floats", true, true, false},
        {"bmp", "BMP", {".bmp"}, "Windows bitmap; written for the levels of a modulator alone", true, false, true},
        {"tiff", "TIFF", {".tif", ".tiff"}, "TIFF, 8 bits sRGB", has_tiff, has_tiff, has_tiff},
        {"jpeg", "JPEG", {".jpg", ".jpeg"}, "JPEG"},
        {"gif", "GIF", {".gif"}, "GIF"},
        {"hdr", "HDR", {".hdr"}, "Radiance RGBE"},
        {"tga", "TGA", {".tga"}, "Targa"},
        {"webp", "WebP", {".webp"}, "WebP", has_webp},
    };
    return formats;
}

const PictureFormat* format_by_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const PictureFormat& format : picture_formats())
        if (std::ranges::count(format.extensions, extension) > 0) return &format;
    return nullptr;
}

std::string list_extensions(bool PictureFormat::*member) {
    std::vector<std::string> names;
    for (const PictureFormat& format : picture_formats())
        if (format.*member) names.push_back(format.extensions.front());
    const std::string last = names.back();
    names.pop_back();
    return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

void refuse_not_built_in(const PictureFormat& format, const std::string& name, const std::string& instead) {
    throw Error(
        ErrorCode::not_built_in,
        fmt::format("'{}': this build of hogel neither reads nor writes {}; {} would do", name, format.title, instead));
}

}  // namespace hogel::image
