// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <charconv>
#include <string_view>

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

}  // namespace

std::optional<std::filesystem::path> find_in_folder(const std::filesystem::path& folder, const std::string& name) {
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    for (const std::string& candidate : {name, slashes, percent_decoded(slashes)}) {
        if (candidate.find('\0') != std::string::npos) continue;
        std::error_code error;
        const auto real = std::filesystem::canonical(folder / candidate, error);
        if (error || !std::filesystem::is_regular_file(real, error)) continue;
        if (std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first == folder.end()) return real;
    }
    return std::nullopt;
}

/// assimp asks for paths that begin with the folder.
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
        // The limits begin with those for the first file, which is the mesh itself.
        if (opened_.size() > 1) core::ChildProcess::raise_limits(further_limits(size));
    }
    if (*real == mesh_ && !contents_.empty())
        return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(contents_.data()), contents_.size());
    return DefaultIOSystem::Open(real->c_str(), mode);
}

}  // namespace hogel::scene::mesh_files
