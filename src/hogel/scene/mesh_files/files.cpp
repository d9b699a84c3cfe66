// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <string_view>

#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/limits.h"

namespace hogel::scene::mesh_files {
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
    const auto lower = [](std::string text) {
        std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
        return text;
    };
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
            if (lower(entry->path().filename().string()) == lower(part.string()) && (!found || entry->path() < *found))
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

/// Opens a file without its UTF-8 byte order mark; null if it has none.
Assimp::IOStream* open_without_mark(const std::filesystem::path& path) {
    std::string start(3, '\0');
    std::ifstream(path, std::ios::binary).read(start.data(), 3);
    if (!starts_with_mark(start)) return nullptr;
    const std::string bytes = read_file(path, std::filesystem::file_size(path), path.filename().string());
    auto* copy = new std::uint8_t[bytes.size()];
    std::ranges::copy(bytes, copy);
    return new Assimp::MemoryIOStream(copy, bytes.size(), true);
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

/// assimp requests paths that begin with the folder.
std::optional<std::filesystem::path> FolderFiles::find(const char* file) const {
    const std::filesystem::path path(file);
    const auto [in_folder, rest] = std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end());
    if (in_folder != folder_.end()) return find_in_folder(folder_, file);
    std::filesystem::path relative;
    for (auto part = rest; part != path.end(); ++part) relative /= *part;
    return find_in_folder(folder_, relative.string());
}

bool FolderFiles::Exists(const char* file) const { return find(file).has_value(); }

Assimp::IOStream* FolderFiles::Open(const char* file, const char* mode) {
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
    const auto real = find(file);
    if (!real) return nullptr;
    if (opened_.insert(*real).second) {
        std::error_code error;
        const std::uintmax_t size = std::filesystem::file_size(*real, error);
        if (error) return nullptr;
        bytes_ += size;
        // The initial limits include the first file, the mesh itself.
        if (opened_.size() > 1) core::ChildProcess::raise_limits(further_limits(size));
    }
    if (*real == mesh_ && !contents_.empty())
        return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(contents_.data()), contents_.size());
    if (Assimp::IOStream* unmarked = open_without_mark(*real)) return unmarked;
    return DefaultIOSystem::Open(real->c_str(), mode);
}

}  // namespace hogel::scene::mesh_files
