#pragma once

#include <cstdint>
#include <filesystem>

#include "hogel/core/array.h"
#include "hogel/image/image.h"

namespace hogel {

/// Writes levels[y][x][c] of 8 bits as they are, with no transfer curve between: what a device is to show. One channel
/// or three; .png, .bmp or .tif by the name. Written to a temporary name and renamed. Throws Error(cannot_write), or
/// Error(usage) for another extension.
void write_levels(const std::filesystem::path& path, View<const std::uint8_t, 3> levels, const Metadata& metadata = {});

/// Throws Error(usage) for a name that write_levels() would refuse.
void require_levels_name(const std::filesystem::path& path);

}  // namespace hogel
