// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace hogel::core {

/// Returns a text with the letters A to Z in lower case.
inline std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

/// Returns the extension of a path in lower case, with its dot.
inline std::string lower_case_extension(const std::filesystem::path& path) {
    return lower_case(path.extension().string());
}

}  // namespace hogel::core
