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
    Provenance provenance;  ///< includes the camera that took the picture, if known

    Image() = default;
    Image(std::size_t width, std::size_t height, std::size_t channels) : pixels(Shape<3>{height, width, channels}) {}
    /// Makes all pixels black and removes the provenance. Reuses the memory if the shape does not change.
    void reset(std::size_t width, std::size_t height, std::size_t channels);
    std::size_t width() const { return pixels.extent(1); }
    std::size_t height() const { return pixels.extent(0); }
    std::size_t channels() const { return pixels.extent(2); }
};

/// Converts linear light to display values by the sRGB curve (IEC 61966-2-1), and back. Both clamp to 0..1.
HOGEL_API float srgb_encode(float linear);
HOGEL_API float srgb_decode(float display);

/// Writes a picture, `metadata` and the picture's provenance in the format of the file name's extension. .exr: linear
/// half floats, or single floats where halves cannot hold the values. .png, and .tif in builds with HOGEL_TIFF: 8-bit
/// sRGB of linear values times `exposure`. The file appears under its name when it is complete. Throws
/// Error(cannot_write), Error(not_built_in) for .tif in other builds, and Error(usage) for another extension or
/// exposure.
HOGEL_API void write_image(const std::filesystem::path& path, const Image& image, double exposure = 1,
                           const Metadata& metadata = {});

/// Throws Error(usage) or Error(not_built_in) if write_image() would refuse the extension of this name.
HOGEL_API void require_picture_name(const std::filesystem::path& path);

/// Returns the bytes of an 8-bit sRGB PNG file, for HTML pages with embedded pictures.
HOGEL_API std::vector<unsigned char> encode_png(const Image& image, double exposure = 1);

/// Reads a picture into linear light, with one or three channels. Formats: PNG, JPEG, EXR, BMP, TGA, GIF (first
/// picture), Radiance HDR, binary PNM, PFM, and TIFF and WebP in builds with HOGEL_TIFF and HOGEL_WEBP. The first bytes
/// of the file decide the format, not the name. Integers of 8 and 16 bits are taken as sRGB, floating-point numbers as
/// linear. Alpha is dropped. Of an EXR file it reads the data window of the first layer with R, G and B, else with Y,
/// else its first channels. Texts in the file become the provenance. Throws Error(bad_input), with the file name, for a
/// file that is missing, damaged or larger than `max_pixels` (before allocating it), and Error(not_built_in).
HOGEL_API Image read_image(const std::filesystem::path& path, std::size_t max_pixels = std::size_t{1} << 28);

/// Decodes a picture file in memory, such as a texture of a glTF file, as read_image() does. `name` is for messages.
HOGEL_API Image decode_image(std::span<const unsigned char> bytes, const std::string& name,
                             std::size_t max_pixels = std::size_t{1} << 28);

/// Pixels of a picture as plain numbers instead of light: values[y][x] as stored in the file.
struct RawPixels {
    Array<float, 2> values;
    std::size_t levels = 0;  ///< 256 or 65536: values are whole numbers below it; 0: floating-point numbers
};
/// Reads the pixels of a picture without a transfer curve. Throws as read_image() does, and Error(bad_input) if colour
/// channels differ.
HOGEL_API RawPixels read_raw_pixels(const std::filesystem::path& path, std::size_t max_pixels = std::size_t{1} << 28);

/// Channels of a picture as plain numbers: values[y][x][c] as stored in the file.
struct RawChannels {
    Array<float, 3> values;   ///< one channel, or three that differ
    std::size_t largest = 0;  ///< largest possible value, such as 255; 0: floating-point numbers
};
/// Reads a picture as read_raw_pixels() does, but accepts different colour channels.
HOGEL_API RawChannels read_raw_channels(const std::filesystem::path& path,
                                        std::size_t max_pixels = std::size_t{1} << 28);

/// Reads the texts that write_image() or other programs stored in a picture file: string attributes (EXR), text chunks
/// (PNG), the comment as "ImageDescription" (JPEG). For TIFF, write_image() stores the texts as lines of
/// "ImageDescription". Throws as read_image() does.
HOGEL_API Metadata read_metadata(const std::filesystem::path& path);

/// Returns the exposure that maps the 99.5th percentile of each pixel's largest channel to display white. The exposure
/// is lower where the median of the pixels that are not black would exceed 0.55 of white, so that a white body on black
/// is not saturated. Pixels of the background in the picture's provenance (background_of()) count as black.
HOGEL_API double automatic_exposure(const Image& image);

/// Differences between two pictures. PSNR, SSIM and the largest error are of display values, sRGB of linear values
/// times the exposure clamped to 0..1, because viewers compare those. All are NaN if a pixel is NaN.
struct ImageComparison {
    double psnr = 0;       ///< dB, peak 1; +infinity for equal pictures
    double ssim = 0;       ///< of luma; mean over all complete Gaussian windows of 11 pixels, σ 1.5 (Wang et al. 2004)
    double max_error = 0;  ///< largest absolute difference of display values
    double linear_psnr = 0;  ///< dB in linear light, peak 1/exposure, not clamped
};

/// Compares two pictures. Throws Error(bad_input) for different or empty sizes, Error(usage) for an invalid exposure.
HOGEL_API ImageComparison compare(const Image& a, const Image& b, double exposure = 1);

/// Writes drive levels of a display or modulator, levels[y][x][c], unchanged and without a transfer curve. The file is
/// a .png with one or three channels; for levels of 8 bits also .bmp, or .tif in builds with HOGEL_TIFF. It appears
/// under its name when it is complete. Throws Error(cannot_write), Error(not_built_in) for .tif in other builds, and
/// Error(usage) for another extension.
HOGEL_API void write_raw_pixels(const std::filesystem::path& path, View<const std::uint8_t, 3> levels,
                                const Metadata& metadata = {});
HOGEL_API void write_raw_pixels(const std::filesystem::path& path, View<const std::uint16_t, 3> levels,
                                const Metadata& metadata = {});

/// Throws Error(usage) or Error(not_built_in) if write_raw_pixels() would refuse the extension of this name.
/// @param levels  number of levels: up to 256 have 8 bits, more have 16
HOGEL_API void require_raw_pixels_name(const std::filesystem::path& path, std::size_t levels = 256);

/// Returns the bytes of an 8-bit sRGB baseline JPEG file without metadata, for display on a screen. Below a quality of
/// 90 colours have half the resolution. `quality` is libjpeg's, 1 to 100. Throws Error(usage) for another quality or an
/// invalid exposure, and Error(not_built_in) in builds without HOGEL_PICTURES.
HOGEL_API std::vector<unsigned char> encode_jpeg(const Image& image, double exposure = 1, int quality = 90);

}  // namespace hogel
