// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/image/display_value.h"
#include "hogel/image/picture_bytes.h"
#include "hogel/image/picture_formats.h"
#include "hogel/work/parallel.h"

namespace hogel {

using namespace image;

namespace {

std::string picture_named(const std::string& name) { return fmt::format("the picture '{}'", name); }

void check_writable(const Image& image, double exposure, const std::string& name) {
    constexpr std::size_t widest = std::numeric_limits<int>::max() / 4;
    if (image.pixels.size() == 0 || image.width() > widest || image.height() > widest ||
        (image.channels() != 1 && image.channels() != 3))
        fail_write(picture_named(name),
                   fmt::format("{}x{} pixels in {} channels", image.width(), image.height(), image.channels()));
    if (!(std::isfinite(exposure) && exposure > 0))
        throw Error(ErrorCode::usage, "exposure",
                    fmt::format("the exposure is {}, but must be positive and finite", exposure));
}

Array<std::uint8_t, 3> display_values(const Image& image, double exposure) {
    Array<std::uint8_t, 3> display(image.pixels.shape());
    work::parallel_for(image.height(), [&](std::size_t y) {
        std::ranges::transform(image.pixels[y].elements(), display[y].elements().begin(),
                               [&](float value) { return display_value(static_cast<float>(value * exposure)); });
    });
    return display;
}

std::vector<unsigned char> encode(const Image& image, double exposure, const std::string& format,
                                  const Metadata& metadata, const std::string& name) {
    return guarded_write(picture_named(name), [&] {
        if (format == "exr") return exr_file(image.pixels, metadata);
        const Array<std::uint8_t, 3> display = display_values(image, exposure);
        return format == "tiff" ? tiff_file(display, metadata) : png_file(display, metadata, Curve::srgb);
    });
}

std::string format_of(const std::filesystem::path& path) {
    const PictureFormat* format = format_by_extension(path);
    if (format != nullptr && !format->built_in)
        refuse_not_built_in(*format, path.string(), &PictureFormat::written_as_picture);
    if (format != nullptr && format->written_as_picture) return format->name;
    throw Error(ErrorCode::usage, fmt::format("'{}': pictures are written as {}", path.string(),
                                              list_extensions(&PictureFormat::written_as_picture)));
}

}  // namespace

void write_image(const std::filesystem::path& path, const Image& image, double exposure, const Metadata& options) {
    const Metadata metadata = with_history(options, to_metadata(image.provenance));
    const std::string format = format_of(path);
    check_writable(image, exposure, path.string());
    core::require_target(path);
    core::write_file(path, encode(image, exposure, format, metadata, path.string()));
}

void require_picture_name(const std::filesystem::path& path) { format_of(path); }

std::vector<unsigned char> encode_png(const Image& image, double exposure) {
    check_writable(image, exposure, "PNG");
    return encode(image, exposure, "png", {}, "PNG");
}

std::vector<unsigned char> encode_jpeg(const Image& image, double exposure, int quality) {
    constexpr std::size_t widest = 65500;  // limit of the format
    check_writable(image, exposure, "JPEG");
    if (quality < 1 || quality > 100)
        throw Error(ErrorCode::usage, fmt::format("the quality of a JPEG picture is 1 to 100, not {}", quality));
    if (image.width() > widest || image.height() > widest)
        fail_write(picture_named("JPEG"),
                   fmt::format("{}x{} pixels; expected at most {} per side", image.width(), image.height(), widest));
    return guarded_write(picture_named("JPEG"), [&] { return jpeg_file(display_values(image, exposure), quality); });
}

}  // namespace hogel
