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
    bool built_in = true;                 ///< false for an optional format that this build lacks
    bool written_as_picture = false;      ///< write_image() writes it
    bool written_as_levels = false;       ///< write_raw_pixels() writes it
};

/// Every format that the library knows; those that are not `built_in` are neither read nor written.
const std::vector<PictureFormat>& picture_formats();

/// The format that the extension of a file's name stands for, in upper or lower case; null for an unknown one.
const PictureFormat* format_by_extension(const std::filesystem::path& path);

/// The extensions of the formats for which a member is true, for messages: ".png, .exr or .tif".
std::string list_extensions(bool PictureFormat::*member);

/// Throws Error(not_built_in) for a file `name` of a format that is not built in; `instead` are those that would do.
[[noreturn]] void refuse_not_built_in(const PictureFormat& format, const std::string& name, const std::string& instead);

}  // namespace hogel::image
