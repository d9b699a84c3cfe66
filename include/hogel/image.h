// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hogel/array.h"
#include "hogel/export.h"
#include "hogel/provenance.h"

namespace hogel {

/// A picture in linear light: pixels[y][x][c], row 0 at the top, one or three channels (R, G, B).
struct HOGEL_API Image {
    Array<float, 3> pixels;
    Provenance provenance;  ///< includes the camera that took the picture, if any

    Image() = default;
    Image(std::size_t width, std::size_t height, std::size_t channels) : pixels(Shape<3>{height, width, channels}) {}
    /// Makes all pixels black and removes the provenance. A picture that already has this shape keeps its memory.
    void reset(std::size_t width, std::size_t height, std::size_t channels);
    std::size_t width() const { return pixels.extent(1); }
    std::size_t height() const { return pixels.extent(0); }
    std::size_t channels() const { return pixels.extent(2); }
};

/// The sRGB transfer curve (IEC 61966-2-1) from linear light to display value and back; both clamp to 0..1.
HOGEL_API float srgb_encode(float linear);
HOGEL_API float srgb_decode(float display);

/// Writes a picture in the format of the name's extension: .exr as linear half floats, or single ones where halves do
/// not hold it, .png as 8-bit sRGB of linear values times `exposure`, with `metadata` and the picture's provenance; in
/// a build with HOGEL_TIFF also .tif, like .png. The file appears under its name when it is complete. Throws
/// Error(cannot_write), Error(not_built_in) for .tif, Error(usage) for an unknown extension or a wrong exposure.
HOGEL_API void write_image(const std::filesystem::path& path, const Image& image, double exposure = 1,
                           const Metadata& metadata = {});

/// Throws Error(usage) or Error(not_built_in) for a name whose extension write_image() would refuse.
HOGEL_API void require_picture_name(const std::filesystem::path& path);

/// The bytes of an 8-bit sRGB PNG file, for HTML pages with embedded pictures.
HOGEL_API std::vector<unsigned char> encode_png(const Image& image, double exposure = 1);

/// Reads a picture into linear light, with one or three channels: PNG, JPEG, EXR, BMP, TGA, GIF (its first picture),
/// Radiance HDR, PNM (binary) or PFM, and TIFF and WebP in builds with HOGEL_TIFF and HOGEL_WEBP. The file's first
/// bytes, not its name, say which. Integers of 8 and 16 bits are taken as sRGB, floating-point numbers as linear; alpha
/// is dropped. Of an EXR file the data window is read, its first layer with R, G and B, else with Y, else its first
/// channels. The texts in the file are its provenance. Throws Error(bad_input), naming the file, for one that is
/// missing, damaged or has more than `max_pixels`, which is known before memory is taken; and Error(not_built_in).
HOGEL_API Image read_image(const std::filesystem::path& path, std::size_t max_pixels = std::size_t{1} << 28);

/// As read_image(), from the bytes of a picture file in memory, such as a texture inside a glTF file.
HOGEL_API Image decode_image(std::span<const unsigned char> bytes, const std::string& name,
                             std::size_t max_pixels = std::size_t{1} << 28);

/// The pixels of a picture as plain numbers instead of light: values[y][x] as stored in the file.
struct RawPixels {
    Array<float, 2> values;
    std::size_t levels =
        0;  ///< 256 or 65536: the values are whole numbers below this; 0: they are floating-point numbers
};
/// Reads the pixels of a picture without a transfer curve. Throws as read_image() does, and Error(bad_input) for a
/// picture whose colour channels differ.
HOGEL_API RawPixels read_raw_pixels(const std::filesystem::path& path, std::size_t max_pixels = std::size_t{1} << 28);

/// The channels of a picture as plain numbers: values[y][x][c] as stored in the file.
struct RawChannels {
    Array<float, 3> values;   ///< one channel, or three that differ somewhere
    std::size_t largest = 0;  ///< the largest number that a pixel could have, such as 255; 0: floating-point numbers
};
/// As read_raw_pixels(), for pictures whose colour channels may differ.
HOGEL_API RawChannels read_raw_channels(const std::filesystem::path& path,
                                        std::size_t max_pixels = std::size_t{1} << 28);

/// Reads the texts stored in a picture file by write_image() or other programs: string attributes of an EXR file, texts
/// of a PNG file, the comment of a JPEG file as "ImageDescription". In a TIFF file write_image() stores them as lines
/// of "ImageDescription". Throws as read_image() does.
HOGEL_API Metadata read_metadata(const std::filesystem::path& path);

/// The exposure that maps the brightest parts of a picture to display white: the 99.5th percentile of each pixel's
/// largest channel; or less, so that the median of the pixels that are not black stays below 0.55 of white, because a
/// white body on black would be white all over. Pixels of the background that the picture's provenance names
/// (background_of()) count as black.
HOGEL_API double automatic_exposure(const Image& image);

/// The difference of two pictures. PSNR, SSIM and the largest error are those of display values, sRGB of linear values
/// times the exposure, clamped to 0..1, because that is what an eye compares.
struct ImageComparison {
    double psnr = 0;         ///< dB, peak 1; +infinity for equal pictures; NaN, as all, where a pixel is NaN
    double ssim = 0;         ///< of luma; mean over all whole Gaussian windows of 11 pixels, σ 1.5 (Wang et al. 2004)
    double max_error = 0;    ///< largest absolute difference of display values
    double linear_psnr = 0;  ///< dB in linear light, peak 1/exposure, not clamped
};

/// Throws Error(bad_input) for pictures of different size or of no pixels, and Error(usage) for an exposure that is not
/// positive and finite.
HOGEL_API ImageComparison compare(const Image& a, const Image& b, double exposure = 1);

/// Writes the drive levels of a display or modulator, levels[y][x][c], unchanged and without a transfer curve, as a
/// .png or .bmp of 8 bits with one or three channels, or .tif in a build with HOGEL_TIFF. The file appears under its
/// name when it is complete. Throws Error(cannot_write), Error(not_built_in) for .tif in other builds, or Error(usage)
/// for another extension.
HOGEL_API void write_raw_pixels(const std::filesystem::path& path, View<const std::uint8_t, 3> levels,
                                const Metadata& metadata = {});

/// Throws Error(usage) or Error(not_built_in) for a name whose extension write_raw_pixels() would refuse.
HOGEL_API void require_raw_pixels_name(const std::filesystem::path& path);

/// The bytes of an 8-bit sRGB JPEG file, for pictures on their way to a screen: baseline, without metadata, colours at
/// half the resolution below a quality of 90. `quality` is libjpeg's, 1 to 100. Throws Error(usage) for another one or
/// a wrong exposure, Error(not_built_in) in a build without HOGEL_PICTURES.
HOGEL_API std::vector<unsigned char> encode_jpeg(const Image& image, double exposure = 1, int quality = 90);

}  // namespace hogel
