// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hogel/array.h"
namespace hogel {

/// A picture in linear light: pixels[y][x][c], row 0 at the top, one or three channels (R, G, B).
struct Image {
    Array<float, 3> pixels;

    Image() = default;
    Image(std::size_t width, std::size_t height, std::size_t channels) : pixels(Shape<3>{height, width, channels}) {}
    std::size_t width() const { return pixels.extent(1); }
    std::size_t height() const { return pixels.extent(0); }
    std::size_t channels() const { return pixels.extent(2); }
};

/// Words that travel inside a picture file: the options and the version that made it.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// The sRGB transfer curve, linear light to display value and back; both clamp to 0..1.
float srgb_encode(float linear);
float srgb_decode(float display);

/// Writes a picture by the extension of the name: .exr as linear half floats, .png and .tif as 8-bit sRGB of
/// linear values times `exposure`. Written to a temporary name beside it and renamed, so that no half file remains.
/// Throws Error(cannot_write), or Error(usage) for an unknown extension.
void write_image(const std::filesystem::path& path, const Image& image, double exposure = 1,
                 const Metadata& metadata = {});

/// Throws Error(usage) for a name that write_image() would refuse, before there is a picture to lose.
void require_picture_name(const std::filesystem::path& path);

/// Encodes a picture as the bytes of an 8-bit sRGB PNG file, for pages that carry their pictures inside.
std::vector<unsigned char> encode_png(const Image& image, double exposure = 1);

/// Reads any picture that OpenImageIO reads, into linear light (8- and 16-bit integer pictures are taken as sRGB), one
/// or three channels (alpha is dropped, two channels become one). Throws Error(bad_input) naming the file; refuses more
/// than `max_pixels`.
Image read_image(const std::filesystem::path& path, std::size_t max_pixels = std::size_t{1} << 28);

/// The same for the bytes of a picture file in memory (a texture inside a glTF file, say).
Image decode_image(std::span<const unsigned char> bytes, const std::string& name,
                   std::size_t max_pixels = std::size_t{1} << 28);

/// What a picture says as numbers and not as light, a number a pixel: values[y][x] as they stand in the file.
struct RawPixels {
    Array<float, 2> values;
    std::size_t levels = 0;  ///< 256 or 65536 for whole numbers below that, 0 for floating point ones
};
/// Throws as read_image() does, and for a picture whose colours differ.
RawPixels read_raw_pixels(const std::filesystem::path& path, std::size_t max_pixels = std::size_t{1} << 28);

/// The words that a picture file carries, those of write_image() and of other programs; a TIFF file keeps them as lines
/// of its "ImageDescription". Throws as read_image() does.
Metadata read_metadata(const std::filesystem::path& path);

/// The exposure that brings the brightest parts (the 99.5th percentile of the largest channel) to display white.
double automatic_exposure(const Image& image);

/// How alike two pictures are. PSNR and SSIM are taken on display values: sRGB of the linear values times the exposure,
/// clamped to 0..1, because that is what an eye compares.
struct ImageComparison {
    double psnr = 0;  ///< dB, peak 1; +infinity for equal pictures
    double ssim = 0;  ///< mean of the luma over all whole windows, Gaussian of 11 pixels, σ 1.5 (Wang et al. 2004)
    double max_error = 0;    ///< largest absolute difference of display values
    double linear_psnr = 0;  ///< dB in linear light, peak 1/exposure, not clamped
};

/// Throws Error(bad_input) for pictures of different size.
ImageComparison compare(const Image& a, const Image& b, double exposure = 1);

/// Writes levels[y][x][c] of 8 bits as they are, with no transfer curve between: what a device is to show. One channel
/// or three; .png, .bmp or .tif by the name. Written to a temporary name and renamed. Throws Error(cannot_write), or
/// Error(usage) for another extension.
void write_raw_pixels(const std::filesystem::path& path, View<const std::uint8_t, 3> levels,
                      const Metadata& metadata = {});

/// Throws Error(usage) for a name that write_raw_pixels() would refuse.
void require_raw_pixels_name(const std::filesystem::path& path);

}  // namespace hogel
