// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hogel::image {

/// Puts an error message of a library on one line.
std::string one_line(std::string text);

/// OpenImageIO's name of the format of a picture file, by its first bytes; null for an unknown one.
const char* picture_format(std::span<const unsigned char> bytes);

/// Describes what is wrong with the outer structure of a PNG or EXR file; "" if nothing is. This check is needed
/// because the libraries that read these files allocate the length that a chunk or an attribute claims before they know
/// whether the file is that long.
std::string structure_error(const std::string& format, std::span<const unsigned char> bytes);

}  // namespace hogel::image
