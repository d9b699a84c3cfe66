// SPDX-License-Identifier: Apache-2.0
#include "hogel/image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <vector>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/image/picture_bytes.h"

namespace hogel {

using namespace image;

namespace {

std::string format_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension == ".png") return "png";
    if (extension == ".bmp") return "bmp";
    if (extension == ".tif" || extension == ".tiff") return "tiff";
    throw Error(ErrorCode::usage, fmt::format("'{}': patterns are written as .png, .bmp or .tif", path.string()));
}

// Encodes an uncompressed Windows bitmap: a file header, BITMAPINFOHEADER, a palette of 256 greys for one channel, and
// rows from the bottom up, padded to four bytes, with colours as blue, green, red.
std::vector<unsigned char> encode_bmp(View<const std::uint8_t, 3> levels) {
    const std::size_t height = levels.extent(0), width = levels.extent(1), channels = levels.extent(2);
    const std::size_t palette = channels == 1 ? 1024 : 0, stride = (width * channels + 3) / 4 * 4;
    std::vector<unsigned char> bytes;
    const auto put = [&](std::size_t value, int size) {
        for (int i = 0; i < size; ++i) bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
    };
    put(0x4d42, 2);  // "BM"
    put(54 + palette + stride * height, 4);
    put(0, 4);
    put(54 + palette, 4);
    put(40, 4);
    put(width, 4);
    put(height, 4);
    put(1, 2);
    put(8 * channels, 2);
    put(0, 4);
    put(stride * height, 4);
    put(0, 8);
    put(channels == 1 ? 256 : 0, 4);
    put(0, 4);
    for (std::size_t grey = 0; grey < palette / 4; ++grey) put(grey * 0x010101, 4);
    for (std::size_t y = height; y-- > 0;) {
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t c = channels; c-- > 0;) bytes.push_back(levels(y, x, c));
        put(0, static_cast<int>(stride - width * channels));
    }
    return bytes;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorCode::cannot_write,
                fmt::format("cannot write the pattern '{}': {}", path.string(), one_line(why)));
}

}  // namespace

void require_raw_pixels_name(const std::filesystem::path& path) { format_of(path); }

void write_raw_pixels(const std::filesystem::path& path, View<const std::uint8_t, 3> levels, const Metadata& metadata) {
    const std::string format = format_of(path);
    const std::size_t channels = levels.extent(2);
    if (levels.size() == 0 || (channels != 1 && channels != 3))
        fail(path, fmt::format("{}x{} pixels in {} channels", levels.extent(1), levels.extent(0), channels));
    if (format == "bmp") return core::write_file(path, encode_bmp(levels));
    core::OutputFile file(path);
    OIIO::ImageSpec spec(static_cast<int>(levels.extent(1)), static_cast<int>(levels.extent(0)),
                         static_cast<int>(channels), OIIO::TypeDesc::UINT8);
    if (channels == 1) spec.channelnames = {"Y"};
    std::string lines;
    for (const auto& [key, value] : metadata) {
        lines += fmt::format("{}: {}\n", key, value);
        if (format == "png") spec.attribute(key, value);
    }
    if (format == "tiff" && !lines.empty()) spec.attribute("ImageDescription", lines);
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
    if (!out) fail(path, OIIO::geterror());
    if (!out->open(file.temporary().string(), spec) || !out->write_image(OIIO::TypeDesc::UINT8, levels.data()) ||
        !out->close())
        fail(path, out->geterror());
    file.commit();
}

}  // namespace hogel
