// SPDX-License-Identifier: Apache-2.0
// Replaces png.cpp, jpeg.cpp, exr.cpp and stb.cpp in a build without their libraries.
#include <string>

#include "hogel/image/formats/formats.h"
#include "hogel/image/picture_formats.h"

namespace hogel::image {
namespace {

[[noreturn]] void refuse_reading(const char* any, const PictureBytes& file) {
    refuse_not_built_in(*format_by_extension(any), file.name, &PictureFormat::read);
}

}  // namespace

Picture read_png(const PictureBytes& file) { refuse_reading("a.png", file); }
Picture read_jpeg(const PictureBytes& file) { refuse_reading("a.jpg", file); }
Picture read_exr(const PictureBytes& file) { refuse_reading("a.exr", file); }
ExrChannels read_exr_channels(const PictureBytes& file) { refuse_reading("a.exr", file); }
Picture read_with_stb(const PictureBytes& file) {
    const std::string start(file.bytes.begin(), file.bytes.begin() + 2);
    refuse_reading(start == "GI" ? "a.gif" : start == "BM" ? "a.bmp" : start == "#?" ? "a.hdr" : "a.tga", file);
}

std::vector<unsigned char> png_file(View<const std::uint8_t, 3>, const Metadata&, Curve) {
    refuse_not_built_in(*format_by_extension("a.png"), "a picture", &PictureFormat::written_as_picture);
}

std::vector<unsigned char> png_file(View<const std::uint16_t, 3>, const Metadata&, Curve) {
    refuse_not_built_in(*format_by_extension("a.png"), "a picture", &PictureFormat::written_as_picture);
}

std::vector<unsigned char> jpeg_file(View<const std::uint8_t, 3>, int) {
    refuse_not_built_in(*format_by_extension("a.jpg"), "a picture", &PictureFormat::read);
}

std::vector<unsigned char> exr_file(View<const float, 3>, const Metadata&) {
    refuse_not_built_in(*format_by_extension("a.exr"), "a picture", &PictureFormat::written_as_picture);
}

std::vector<unsigned char> exr_channels_file(const ExrChannels&) {
    refuse_not_built_in(*format_by_extension("a.exr"), "a file", &PictureFormat::written_as_picture);
}

}  // namespace hogel::image
