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

/// Shortens a message of another library to one line.
std::string one_line(const std::string& message);

/// Returns whether the name has one of these extensions, ignoring case.
bool has_extension(const std::filesystem::path& path, std::initializer_list<std::string_view> extensions);
bool is_gltf(const std::filesystem::path& path);
bool starts_like_ply(std::string_view bytes);

/// Returns whether a text begins with the byte order mark of UTF-8.
bool starts_with_mark(std::string_view bytes);

/// Reads a file of `size` bytes, and removes such a mark. Throws Error(bad_input), naming `file`.
std::string read_file(const std::filesystem::path& path, std::uintmax_t size, const std::string& file);

/// Returns the size of a file in bytes. Throws Error(bad_input) for a file that is missing, not regular, empty or
/// larger than 4 GiB.
std::uintmax_t check_regular_file(const std::filesystem::path& path);

}  // namespace hogel::scene::mesh_files
