// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/find_in_folder.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "hogel/core/lower_case.h"

namespace hogel::scene {
namespace {

std::string percent_decoded(const std::string& text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            decoded += static_cast<char>(value);
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

/// Finds a path in a folder ignoring case; the first by name if several match.
std::optional<std::filesystem::path> find_in_other_case(const std::filesystem::path& folder,
                                                        const std::filesystem::path& name) {
    std::filesystem::path current = folder;
    for (const std::filesystem::path& part : name) {
        std::error_code error;
        if (std::filesystem::exists(current / part, error)) {
            current /= part;
            continue;
        }
        std::optional<std::filesystem::path> found;
        for (std::filesystem::directory_iterator entry(current, error), end; !error && entry != end;
             entry.increment(error))
            if (core::lower_case(entry->path().filename().string()) == core::lower_case(part.string()) &&
                (!found || entry->path() < *found))
                found = entry->path();
        if (!found) return std::nullopt;
        current = *found;
    }
    return current;
}

/// Returns the regular file of a path if it is in the folder or below.
std::optional<std::filesystem::path> regular_file(const std::filesystem::path& folder,
                                                  const std::filesystem::path& path) {
    std::error_code error;
    const auto real = std::filesystem::canonical(path, error);
    if (error || !std::filesystem::is_regular_file(real, error)) return std::nullopt;
    if (std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first != folder.end())
        return std::nullopt;
    return real;
}

}  // namespace

std::optional<std::filesystem::path> find_in_folder(const std::filesystem::path& folder, const std::string& name) {
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    const std::array candidates{name, slashes, percent_decoded(slashes)};
    const auto is_path = [](const std::string& candidate) { return candidate.find('\0') == std::string::npos; };
    for (const std::string& candidate : candidates)
        if (is_path(candidate))
            if (auto real = regular_file(folder, folder / candidate)) return real;
    for (const std::string& candidate : candidates)
        if (is_path(candidate) && !std::filesystem::path(candidate).has_root_path())
            if (const auto path = find_in_other_case(folder, candidate))
                if (auto real = regular_file(folder, *path)) return real;
    return std::nullopt;
}

}  // namespace hogel::scene
