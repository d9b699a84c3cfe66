// SPDX-License-Identifier: Apache-2.0
#include "hogel/image.h"

#include <fmt/format.h>

#include <functional>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/image/picture_bytes.h"
#include "hogel/image/picture_formats.h"

namespace hogel {

using namespace image;

namespace {

constexpr std::size_t levels_of_8_bits = 256;

std::string levels_format_of(const std::filesystem::path& path, std::size_t levels) {
    const PictureFormat* format = format_by_extension(path);
    if (format != nullptr && !format->built_in)
        refuse_not_built_in(*format, path.string(), &PictureFormat::written_as_levels);
    if (format != nullptr && format->written_as_levels && (levels <= levels_of_8_bits || format->name == "png"))
        return format->name;
    throw Error(ErrorCode::usage,
                fmt::format("'{}': patterns {}are written as {}", path.string(),
                            levels <= levels_of_8_bits ? "" : fmt::format("of more than {} levels ", levels_of_8_bits),
                            levels <= levels_of_8_bits ? list_extensions(&PictureFormat::written_as_levels) : ".png"));
}

// Writes the bytes of encode(format).
template <class T>
void write_levels(const std::filesystem::path& path, View<const T, 3> levels,
                  const std::function<std::vector<unsigned char>(const std::string& format)>& encode) {
    const std::string format = levels_format_of(path, sizeof(T) == 1 ? levels_of_8_bits : levels_of_8_bits + 1),
                      what = fmt::format("the pattern '{}'", path.string());
    const std::size_t channels = levels.extent(2);
    if (levels.size() == 0 || (channels != 1 && channels != 3))
        fail_write(what, fmt::format("{}x{} pixels in {} channels", levels.extent(1), levels.extent(0), channels));
    core::require_target(path);
    core::write_file(path, guarded_write(what, [&] { return encode(format); }));
}

}  // namespace

void require_raw_pixels_name(const std::filesystem::path& path, std::size_t levels) { levels_format_of(path, levels); }

void write_raw_pixels(const std::filesystem::path& path, View<const std::uint8_t, 3> levels, const Metadata& metadata) {
    write_levels(path, levels, [&](const std::string& format) {
        return format == "bmp"    ? bmp_file(levels)
               : format == "tiff" ? tiff_file(levels, metadata)
                                  : png_file(levels, metadata, Curve::none);
    });
}

void write_raw_pixels(const std::filesystem::path& path, View<const std::uint16_t, 3> levels,
                      const Metadata& metadata) {
    write_levels(path, levels, [&](const std::string&) { return png_file(levels, metadata, Curve::none); });
}

}  // namespace hogel
