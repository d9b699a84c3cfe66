// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hogel::scene::mesh_files {

/// Runs in a child process: reads a mesh file by assimp, sends its contents (transfer.h) or an error, and exits.
/// @param path      canonical
/// @param file      name of the mesh for messages, as given by the caller
/// @param contents  replaces the contents of the file unless empty
/// @param numbered  whether materials are only indices into GltfMaterials, as in CheckedGltf::contents
[[noreturn]] void import_with_assimp(const std::filesystem::path& path, const std::string& file,
                                     std::string_view contents, bool numbered, int pipe) noexcept;

}  // namespace hogel::scene::mesh_files
