// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hogel::image {

/// A format of picture files.
struct PictureFormat {
    std::string name;                     ///< "png"
    std::string title;                    ///< for messages: "PNG"
    std::vector<std::string> extensions;  ///< in lower case: ".png"
    std::string text;                     ///< what it is, one line
    std::string part;                     ///< of the library, which reads and writes it (hogel/parts.h); may be empty
    bool built_in = true;                 ///< false where this build lacks that part
    bool read = true;                     ///< read_image() reads it
    bool written_as_picture = false;      ///< write_image() writes it
    bool written_as_levels = false;       ///< write_raw_pixels() writes it
};

/// Every format that the library knows; those that are not `built_in` are neither read nor written.
const std::vector<PictureFormat>& picture_formats();

/// The format that the extension of a file's name stands for, in upper or lower case; null for an unknown one.
const PictureFormat* format_by_extension(const std::filesystem::path& path);

/// The extensions of the formats for which a member is true, for messages: ".png, .exr or .tif"; "nothing"
/// where there is none.
std::string list_extensions(bool PictureFormat::*member);

/// Throws Error(not_built_in) for a file `name` of a format that is not built in. Built-in formats for which `wanted`
/// is true are named as what would do.
[[noreturn]] void refuse_not_built_in(const PictureFormat& format, const std::string& name,
                                      bool PictureFormat::*wanted);

}  // namespace hogel::image
