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

/// One reader per picture format, and one writer per format that hogel writes. Each is in a source file of its own, the
/// only one that includes the library of the format. Readers and writers work in memory; callers access the files.
namespace hogel::image {

/// The bytes of a picture file and the options of a reader.
struct PictureBytes {
    std::span<const unsigned char> bytes;
    std::string name;            ///< for error messages
    std::size_t max_pixels = 0;  ///< maximum accepted by check_size()
    bool only_texts = false;     ///< do not read the pixels; check_size() is not called
    /// Return alpha as a fourth channel. For PNG, TGA and WebP; other readers ignore it.
    bool with_alpha = false;

    /// Throws Error(bad_input) with the name and the reason on one line.
    [[noreturn]] void fail(const std::string& why) const;
    /// Throws Error(bad_input) for header sizes that are invalid, exceed `max_pixels`, or do not fit into a file of
    /// this length. Readers call it before they allocate memory by sizes in the header.
    /// @param channels      number of channels in the file
    /// @param sample_bytes  size of a sample in memory
    void check_size(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                    std::uint64_t sample_bytes) const;
};

/// Samples [y][x][c] as stored in a file, row 0 at the top. One or three channels (R, G, B), and alpha as a fourth if
/// PictureBytes::with_alpha; other channels are dropped. Integers have a transfer curve, floats are linear.
using Samples = std::variant<Array<std::uint8_t, 3>, Array<std::uint16_t, 3>, Array<float, 3>>;

struct Picture {
    Samples samples;  ///< empty if only_texts
    Metadata texts;
    /// Largest possible code, if smaller than the sample type allows: 1023 for a 10-bit pixmap; otherwise 0.
    std::uint32_t max_code = 0;
};

// The readers. They throw Error(bad_input) through PictureBytes, or std::exception with a reason. Readers and writers
// of formats that are not built in throw Error(not_built_in).
Picture read_png(const PictureBytes& file);
Picture read_jpeg(const PictureBytes& file);
/// Reads the data window of the first part. Uses the first layer with colours or luminance.
Picture read_exr(const PictureBytes& file);
/// Full-resolution channels of the first part of an EXR file, by name, as [y][x].
struct ExrChannels {
    std::vector<std::pair<std::string, Array<float, 2>>> channels;
    Metadata texts;
};
/// With `only_texts` reads only the names of the channels and the texts.
ExrChannels read_exr_channels(const PictureBytes& file);
/// Reads BMP, TGA, the first picture of a GIF, and Radiance HDR.
Picture read_with_stb(const PictureBytes& file);
/// Reads binary portable pixmaps, P5 and P6.
Picture read_pnm(const PictureBytes& file);
Picture read_pfm(const PictureBytes& file);
Picture read_tiff(const PictureBytes& file);
Picture read_webp(const PictureBytes& file);

/// Returns whether the bytes begin like a TGA file, which has no signature.
bool begins_like_tga(std::span<const unsigned char> bytes);

// The writers return the bytes of a file. Pixels are [y][x][c] with one or three channels. read_metadata() describes
// the storage of `texts`. They throw std::exception with a reason.
enum class Curve { srgb, none };  ///< whether a PNG file declares its samples as sRGB
std::vector<unsigned char> png_file(View<const std::uint8_t, 3> pixels, const Metadata& texts, Curve curve);
std::vector<unsigned char> png_file(View<const std::uint16_t, 3> pixels, const Metadata& texts, Curve curve);
/// Codes 0 to max_code: one byte each if max_code <= 255, otherwise two.
std::vector<unsigned char> pnm_file(View<const std::uint16_t, 3> codes, std::uint32_t max_code);
std::vector<unsigned char> pfm_file(View<const float, 3> pixels);
std::vector<unsigned char> exr_file(View<const float, 3> pixels, const Metadata& texts);
/// Channels of 32-bit floats, of equal size.
std::vector<unsigned char> exr_channels_file(const ExrChannels& picture);
/// Baseline JPEG with a quality of 1 to 100; below 90 the colours have half the resolution.
std::vector<unsigned char> jpeg_file(View<const std::uint8_t, 3> pixels, int quality);
std::vector<unsigned char> bmp_file(View<const std::uint8_t, 3> pixels);
std::vector<unsigned char> tiff_file(View<const std::uint8_t, 3> pixels, const Metadata& texts);

}  // namespace hogel::image
