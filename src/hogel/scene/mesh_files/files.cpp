// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>

#include "hogel/scene/mesh_files/files.h"

namespace hogel::scene::mesh_files {

bool FolderFiles::contains(const std::filesystem::path& path) const {
    std::error_code error;
    const auto real = std::filesystem::canonical(path, error);
    if (error || !std::filesystem::is_regular_file(real, error)) return false;
    return std::mismatch(folder_.begin(), folder_.end(), real.begin(), real.end()).first == folder_.end();
}

bool FolderFiles::Exists(const char* file) const { return contains(file); }

Assimp::IOStream* FolderFiles::Open(const char* file, const char* mode) {
    const bool reading = std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
    return reading && contains(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
}

}  // namespace hogel::scene::mesh_files
