// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace hogel::scene::mesh_files {

/// The file that a mesh file means by a relative path or URI ("my%20wood.png" is "my wood.png" where no file has the
/// undecoded name), after following symbolic links: a regular file in the folder or below, or none. Where there is no
/// such file, letters may be of the other case. Paths in a mesh file are not trusted.
/// @param folder  canonical
std::optional<std::filesystem::path> find_in_folder(const std::filesystem::path& folder, const std::string& name);

/// Restricts assimp to regular files in one folder and below, in the child process that it runs in.
/// With each file that it opens, the child may use more memory and time: in proportion to what there is to read.
class FolderFiles final : public Assimp::DefaultIOSystem {
  public:
    /// @param mesh      the file that assimp is to read, canonical
    /// @param contents  what is read instead of what that file holds, unless it is empty; lives longer than this
    FolderFiles(const std::filesystem::path& mesh, std::string_view contents)
        : folder_(mesh.parent_path()), mesh_(mesh), contents_(contents) {}
    bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;

    const std::set<std::filesystem::path>& opened() const { return opened_; }
    /// Bytes of all files opened, each counted once.
    std::uint64_t bytes_opened() const { return bytes_; }

  private:
    std::optional<std::filesystem::path> find(const char* file) const;

    std::filesystem::path folder_, mesh_;  // canonical
    std::string_view contents_;
    std::set<std::filesystem::path> opened_;
    std::uint64_t bytes_ = 0;
};

}  // namespace hogel::scene::mesh_files
