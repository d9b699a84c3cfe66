// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hogel::scene::mesh_files {

/// Throws Error(bad_input) "file: what; expected ...".
[[noreturn]] void reject_file(const std::string& file, const std::string& what, const std::string& expected);

/// Shortens a message of another library to a single line of moderate length.
std::string one_line(const std::string& message);

bool is_gltf(const std::filesystem::path& path);

/// Throws Error(bad_input) for files that assimp must not read: missing, not regular, empty, or of a size or content on
/// which its readers are known to crash or hang.
void check_mesh_file(const std::filesystem::path& path);

/// Check the sizes and references in a glTF or PLY file, which assimp 5.2 does not check. `bytes` is the whole file.
/// Both throw Error(bad_input) by reject_file().
void check_gltf(const std::string& file, std::string_view bytes);
void check_ply(const std::string& file, std::string_view bytes);

}  // namespace hogel::scene::mesh_files
