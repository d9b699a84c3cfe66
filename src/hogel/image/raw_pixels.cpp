// SPDX-License-Identifier: Apache-2.0
#include "hogel/image.h"

#include <fmt/format.h>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/image/picture_bytes.h"
#include "hogel/image/picture_formats.h"

namespace hogel {

using namespace image;

namespace {

std::string levels_format_of(const std::filesystem::path& path) {
    const PictureFormat* format = format_by_extension(path);
    if (format != nullptr && !format->built_in)
        refuse_not_built_in(*format, path.string(), &PictureFormat::written_as_levels);
    if (format != nullptr && format->written_as_levels) return format->name;
    throw Error(ErrorCode::usage, fmt::format("'{}': patterns are written as {}", path.string(),
                                              list_extensions(&PictureFormat::written_as_levels)));
}

}  // namespace

void require_raw_pixels_name(const std::filesystem::path& path) { levels_format_of(path); }

void write_raw_pixels(const std::filesystem::path& path, View<const std::uint8_t, 3> levels, const Metadata& metadata) {
    const std::string format = levels_format_of(path), what = fmt::format("the pattern '{}'", path.string());
    const std::size_t channels = levels.extent(2);
    if (levels.size() == 0 || (channels != 1 && channels != 3))
        fail_write(what, fmt::format("{}x{} pixels in {} channels", levels.extent(1), levels.extent(0), channels));
    core::require_target(path);
    core::write_file(path, guarded_write(what, [&] {
                         return format == "bmp"    ? bmp_file(levels)
                                : format == "tiff" ? tiff_file(levels, metadata)
                                                   : png_file(levels, metadata, Curve::none);
                     }));
}

}  // namespace hogel
