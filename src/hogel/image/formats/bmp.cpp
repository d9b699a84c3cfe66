// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/formats/formats.h"

namespace hogel::image {

// Uncompressed Windows bitmap: file header, BITMAPINFOHEADER, a palette of 256 greys for one channel, and rows from the
// bottom up, padded to four bytes. Colours are in the order blue, green, red.
std::vector<unsigned char> bmp_file(View<const std::uint8_t, 3> pixels) {
    const std::size_t height = pixels.extent(0), width = pixels.extent(1), channels = pixels.extent(2);
    const std::size_t palette = channels == 1 ? 1024 : 0, stride = (width * channels + 3) / 4 * 4;
    std::vector<unsigned char> bytes;
    bytes.reserve(54 + palette + stride * height);
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
            for (std::size_t c = channels; c-- > 0;) bytes.push_back(pixels(y, x, c));
        put(0, static_cast<int>(stride - width * channels));
    }
    return bytes;
}

}  // namespace hogel::image
