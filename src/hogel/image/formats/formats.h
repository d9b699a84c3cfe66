// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hogel/array.h"
#include "hogel/provenance.h"

/// One reader, and where hogel writes the format one writer, for each format of pictures. Each is in a file of its own
/// that alone includes the format's library. Readers and writers keep to memory: files are read and written by callers.
namespace hogel::image {

/// The bytes of a picture file and what a reader must know about the request.
struct PictureBytes {
    std::span<const unsigned char> bytes;
    std::string name;            ///< for messages
    std::size_t max_pixels = 0;  ///< check_size() refuses more
    bool only_texts = false;     ///< leave the pixels unread; check_size() is not called
    /// Keep alpha, in a picture of four channels. PNG, TGA and WebP; readers of other formats leave it out.
    bool with_alpha = false;

    /// Throws Error(bad_input) with the name and the reason on one line.
    [[noreturn]] void fail(const std::string& why) const;
    /// Throws Error(bad_input) for sizes of a header that cannot be, that are more than `max_pixels`, or that no file
    /// of so few bytes holds. Readers call it before they allocate anything by the header's sizes. `channels` are those
    /// of the file, `sample_bytes` the size of each sample in memory.
    void check_size(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                    std::uint64_t sample_bytes) const;
};

/// Samples [y][x][c] as stored in a file, row 0 at the top, with one or three channels (R, G, B), or with alpha as
/// a fourth where PictureBytes asks for it; other channels are left out. Whole numbers have a transfer curve,
/// floating-point numbers are linear.
using Samples = std::variant<Array<std::uint8_t, 3>, Array<std::uint16_t, 3>, Array<float, 3>>;

/// What a reader finds in a file.
struct Picture {
    Samples samples;  ///< empty if only texts were asked for
    Metadata texts;
    /// The largest code that the file may hold where that is less than its samples may: a pixmap of 10 bits has 1023.
    std::uint32_t max_code = 0;
};

// The readers. They throw Error(bad_input), by PictureBytes, or std::exception with a reason. Those of formats that a
// build lacks throw Error(not_built_in), and so do their writers.
Picture read_png(const PictureBytes& file);
Picture read_jpeg(const PictureBytes& file);
/// The first part of the file, its data window alone. Of several layers the first with colours or luminance is taken.
Picture read_exr(const PictureBytes& file);
/// The channels of the first part of an EXR file that have a sample for each pixel, by name, as [y][x].
struct ExrChannels {
    std::vector<std::pair<std::string, Array<float, 2>>> channels;
    Metadata texts;
};
/// With `only_texts` the names of the channels and the texts alone.
ExrChannels read_exr_channels(const PictureBytes& file);
/// BMP, TGA, the first picture of a GIF, and Radiance HDR.
Picture read_with_stb(const PictureBytes& file);
/// Portable pixmaps, P5 and P6.
Picture read_pnm(const PictureBytes& file);
/// Portable float maps.
Picture read_pfm(const PictureBytes& file);
Picture read_tiff(const PictureBytes& file);
Picture read_webp(const PictureBytes& file);

/// Whether the bytes begin like a TGA file, which has no signature.
bool begins_like_tga(std::span<const unsigned char> bytes);

// The writers, to the bytes of a file. Pixels are [y][x][c] with one or three channels; `texts` are stored as
// read_metadata() describes. They throw std::exception with a reason.
enum class Curve { srgb, none };  ///< whether a PNG file says that its samples are sRGB
std::vector<unsigned char> png_file(View<const std::uint8_t, 3> pixels, const Metadata& texts, Curve curve);
/// 16 bits a sample.
std::vector<unsigned char> png_file(View<const std::uint16_t, 3> pixels, const Metadata& texts, Curve curve);
/// Codes 0 to max_code, of which those beyond 255 take two bytes each.
std::vector<unsigned char> pnm_file(View<const std::uint16_t, 3> codes, std::uint32_t max_code);
std::vector<unsigned char> pfm_file(View<const float, 3> pixels);
std::vector<unsigned char> exr_file(View<const float, 3> pixels, const Metadata& texts);
/// Channels of single floats and of one size. Throws std::exception.
std::vector<unsigned char> exr_channels_file(const ExrChannels& picture);
/// Baseline JPEG of a quality from 1 to 100; below 90 with colours at half the resolution.
std::vector<unsigned char> jpeg_file(View<const std::uint8_t, 3> pixels, int quality);
std::vector<unsigned char> bmp_file(View<const std::uint8_t, 3> pixels);
std::vector<unsigned char> tiff_file(View<const std::uint8_t, 3> pixels, const Metadata& texts);

}  // namespace hogel::image
