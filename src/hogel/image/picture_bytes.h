// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hogel::image {

/// What a library has to say, on one line.
std::string one_line(std::string text);

/// OpenImageIO's name for the format that a picture file's first bytes announce, or nullptr.
const char* picture_format(std::span<const unsigned char> bytes);

/// What is wrong with the outer structure of a PNG or EXR file, or "". The libraries that read these files take memory
/// for whatever length a chunk or an attribute claims, before they look whether the file is that long.
std::string structure_error(const std::string& format, std::span<const unsigned char> bytes);

}  // namespace hogel::image
