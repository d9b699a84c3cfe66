// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hogel::image {

/// A format of picture files.
struct PictureFormat {
    std::string name;                     ///< "png"
    std::string title;                    ///< for error messages: "PNG"
    std::vector<std::string> extensions;  ///< lower case: ".png"
    std::string text;                     ///< description, one line
    std::string part;                 ///< part of the library that reads and writes it (hogel/parts.h); may be empty
    bool built_in = true;             ///< false if this build lacks that part
    bool read = true;                 ///< supported by read_image()
    bool written_as_picture = false;  ///< supported by write_image()
    bool written_as_levels = false;   ///< supported by write_raw_pixels()
};

/// Returns all known formats. Formats that are not `built_in` are neither read nor written.
const std::vector<PictureFormat>& picture_formats();

/// Returns the format for the extension of a file name, case-insensitive, or null if it is unknown.
const PictureFormat* format_by_extension(const std::filesystem::path& path);

/// Returns the extensions of formats with a true member, for messages: ".png, .exr or .tif"; "nothing" for none.
std::string list_extensions(bool PictureFormat::*member);

/// Throws Error(not_built_in) for a file `name` of a format that is not built in. The message names the built-in
/// formats for which `wanted` is true as alternatives.
[[noreturn]] void refuse_not_built_in(const PictureFormat& format, const std::string& name,
                                      bool PictureFormat::*wanted);

}  // namespace hogel::image
