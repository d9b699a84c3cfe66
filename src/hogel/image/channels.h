// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hogel/array.h"
#include "hogel/provenance.h"

namespace hogel::image {

/// The named channels of an EXR file, [y][x], and its text attributes.
struct NamedChannels {
    std::vector<std::pair<std::string, Array<float, 2>>> channels;
    Metadata texts;
};

/// Reads all floating-point channels, not only colours. Throws as read_image() does.
/// @param only_names  do not read the samples
NamedChannels read_named_channels(const std::filesystem::path& path, bool only_names = false);

/// Writes channels of equal size as 32-bit floats. Throws Error(cannot_write) and Error(not_built_in).
void write_named_channels(const std::filesystem::path& path, NamedChannels picture);

}  // namespace hogel::image
