// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/provenance.h"

namespace hogel::scene::mesh_files {

/// Throws Error(bad_input) "file: what; expected ...".
[[noreturn]] void reject_file(const std::string& file, const std::string& what, const std::string& expected);

/// Shortens a message of another library to a single line of moderate length.
std::string one_line(const std::string& message);

/// Whether the name ends in one of these, in letters of any case.
bool has_extension(const std::filesystem::path& path, std::initializer_list<std::string_view> extensions);
bool is_gltf(const std::filesystem::path& path);
bool starts_like_ply(std::string_view bytes);

/// All bytes of a file. Throws Error(bad_input), which names `file`.
std::string read_file(const std::filesystem::path& path, std::uintmax_t size, const std::string& file);

/// Throws Error(bad_input) for a file that is missing, not regular, empty or larger than any mesh.
std::uintmax_t check_regular_file(const std::filesystem::path& path);

/// Checks what a PLY file announces, which assimp 5.2 does not check. `bytes` is the whole file. Throws
/// Error(bad_input) by reject_file().
void check_ply(const std::string& file, std::string_view bytes);

/// What a PLY file has that is not shown, a note each: colours of faces, edges, strips of triangles.
std::vector<std::string> notes_of_ply(const std::string& file, std::string_view bytes);

}  // namespace hogel::scene::mesh_files
