// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/limits.h"

namespace hogel::scene::mesh_files {
namespace {

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
