// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/picture_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hogel/core/lower_case.h"
#include "hogel/core/part.h"
#include "hogel/error.h"

namespace hogel::image {
namespace {

std::vector<PictureFormat> all_formats() {
    const char* const pictures = "pictures";
    const bool has_pictures = core::part(pictures).built_in;
    std::vector<PictureFormat> formats{
        {.name = "png",
         .title = "PNG",
         .extensions = {".png"},
         .text = "PNG, 8 bits sRGB",
         .part = pictures,
         .written_as_picture = true,
         .written_as_levels = true},
        {.name = "exr",
         .title = "OpenEXR",
         .extensions = {".exr"},
         .text = "OpenEXR, linear half floats",
         .part = pictures,
         .written_as_picture = true},
        {.name = "bmp",
         .title = "BMP",
         .extensions = {".bmp"},
         .text = "Windows bitmap; written for the levels of a modulator alone",
         .part = {},
         .read = has_pictures,  // writing needs no library
         .written_as_levels = true},
        {.name = "tiff",
         .title = "TIFF",
         .extensions = {".tif", ".tiff"},
         .text = "TIFF, 8 bits sRGB",
         .part = "TIFF",
         .written_as_picture = true,
         .written_as_levels = true},
        {.name = "jpeg", .title = "JPEG", .extensions = {".jpg", ".jpeg"}, .text = "JPEG", .part = pictures},
        {.name = "gif", .title = "GIF", .extensions = {".gif"}, .text = "GIF", .part = pictures},
        {.name = "hdr", .title = "HDR", .extensions = {".hdr"}, .text = "Radiance RGBE", .part = pictures},
        {.name = "tga", .title = "TGA", .extensions = {".tga"}, .text = "Targa", .part = pictures},
        {.name = "pnm",
         .title = "PNM",
         .extensions = {".ppm", ".pgm", ".pnm"},
         .text = "portable pixmaps of 8 to 16 bits, binary",
         .part = {}},
        {.name = "pfm", .title = "PFM", .extensions = {".pfm"}, .text = "portable float maps, linear", .part = {}},
        {.name = "webp", .title = "WebP", .extensions = {".webp"}, .text = "WebP", .part = "WebP"},
    };
    for (PictureFormat& format : formats) {
        format.built_in = format.part.empty() || core::part(format.part).built_in;
        if (!format.built_in) format.read = format.written_as_picture = format.written_as_levels = false;
    }
    return formats;
}

std::string list(std::vector<std::string> names) {
    if (names.size() < 2) return names.empty() ? "nothing" : names.front();
    const std::string last = names.back();
    names.pop_back();
    return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

}  // namespace

const std::vector<PictureFormat>& picture_formats() {
    static const std::vector<PictureFormat> formats = all_formats();
    return formats;
}

const PictureFormat* format_by_extension(const std::filesystem::path& path) {
    const std::string extension = core::lower_case_extension(path);
    for (const PictureFormat& format : picture_formats())
        if (std::ranges::count(format.extensions, extension) > 0) return &format;
    return nullptr;
}

std::string list_extensions(bool PictureFormat::*member) {
    std::vector<std::string> names;
    for (const PictureFormat& format : picture_formats())
        if (format.*member) names.push_back(format.extensions.front());
    return list(std::move(names));
}

void refuse_not_built_in(const PictureFormat& format, const std::string& name, bool PictureFormat::*wanted) {
    std::vector<std::string> titles;
    for (const PictureFormat& other : picture_formats())
        if (other.*wanted) titles.push_back(other.title);
    throw Error(ErrorCode::not_built_in,
                fmt::format("'{}': this build of hogel neither reads nor writes {}; the build option {} brings it{}",
                            name, format.title, core::part(format.part.empty() ? "pictures" : format.part).option,
                            titles.empty() ? "" : fmt::format(", and {} would do", list(std::move(titles)))));
}

}  // namespace hogel::image
