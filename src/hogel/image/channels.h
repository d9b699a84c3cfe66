// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hogel/array.h"
#include "hogel/provenance.h"

namespace hogel::image {

/// The channels of an EXR file by name, [y][x], and its texts.
struct NamedChannels {
    std::vector<std::pair<std::string, Array<float, 2>>> channels;
    Metadata texts;
};

/// Reads the channels of floating-point numbers, all of them and not only colours. Throws as read_image() does.
/// @param only_names  leave the samples unread
NamedChannels read_named_channels(const std::filesystem::path& path, bool only_names = false);

/// Writes channels of one size as single floats. Throws Error(cannot_write) and Error(not_built_in).
void write_named_channels(const std::filesystem::path& path, NamedChannels picture);

}  // namespace hogel::image
