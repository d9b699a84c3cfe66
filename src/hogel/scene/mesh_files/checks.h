// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hogel::scene::mesh_files {

/// Throws Error(bad_input) "file: what; expected ...".
[[noreturn]] void reject_file(const std::string& file, const std::string& what, const std::string& expected);

/// Somebody else's message as a single line of moderate length.
std::string one_line(const std::string& message);

bool is_gltf(const std::filesystem::path& path);

/// Refuses what assimp should not be handed: missing, not a regular file, empty, or of a size or content that its
/// readers are known to crash or hang on.
void check_mesh_file(const std::filesystem::path& path);

/// What a glTF or PLY file must keep to before assimp may see it: assimp 5.2 trusts these promises. `bytes` is the
/// whole file. Both throw Error(bad_input) by reject_file.
void check_gltf(const std::string& file, std::string_view bytes);
void check_ply(const std::string& file, std::string_view bytes);

}  // namespace hogel::scene::mesh_files
