// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "hogel/scene/find_in_folder.h"

namespace hogel::scene::mesh_files {

/// File access of assimp, restricted to regular files in one folder and below, in the child process. Raises the child's
/// memory and time limits in proportion to the size of each opened file.
class FolderFiles final : public Assimp::DefaultIOSystem {
  public:
    /// @param mesh      the mesh file, canonical
    /// @param contents  replaces the contents of that file unless empty; must outlive this
    FolderFiles(const std::filesystem::path& mesh, std::string_view contents)
        : folder_(mesh.parent_path()), mesh_(mesh), contents_(contents) {}
    bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;

    const std::set<std::filesystem::path>& opened() const { return opened_; }
    /// Bytes of all opened files, each counted once.
    std::uint64_t bytes_opened() const { return bytes_; }

  private:
    std::optional<std::filesystem::path> find(const char* file) const;

    std::filesystem::path folder_, mesh_;  // canonical
    std::string_view contents_;
    std::set<std::filesystem::path> opened_;
    std::uint64_t bytes_ = 0;
};

}  // namespace hogel::scene::mesh_files
