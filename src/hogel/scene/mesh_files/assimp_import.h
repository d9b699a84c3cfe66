// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hogel::scene::mesh_files {

/// In a child process: reads a mesh file by assimp and sends what it holds (transfer.h), or the reason why not, into
/// the pipe. Ends the process.
/// @param path  canonical
/// @param file  name of the mesh for messages, as the caller gave it
/// @param contents  read instead of what the file holds, unless it is empty
/// @param numbered  whether materials are only the numbers of those of GltfMaterials: of CheckedGltf::contents
[[noreturn]] void import_with_assimp(const std::filesystem::path& path, const std::string& file,
                                     std::string_view contents, bool numbered, int pipe) noexcept;

}  // namespace hogel::scene::mesh_files
