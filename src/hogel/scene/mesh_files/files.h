// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>

namespace hogel::scene::mesh_files {

/// Restricts assimp to regular files in one folder and below, because paths in a mesh file are not trusted.
class FolderFiles final : public Assimp::DefaultIOSystem {
  public:
    explicit FolderFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
    bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;

    /// Whether a path, after following symbolic links, is a regular file inside the folder.
    bool contains(const std::filesystem::path& path) const;

  private:
    std::filesystem::path folder_;  // canonical
};

}  // namespace hogel::scene::mesh_files
