#pragma once

#include <filesystem>
#include <string>

namespace hogel {

/// Throws Error(bad_input) "file: what; expected ...".
[[noreturn]] void reject_file(const std::string& file, const std::string& what, const std::string& expected);

/// Somebody else's message as a single line of moderate length.
std::string one_line(const std::string& message);

bool is_gltf(const std::filesystem::path& path);

/// Refuses what assimp should not be handed: missing, not a regular file, empty, or of a size or content that its
/// readers are known to crash or hang on.
void check_mesh_file(const std::filesystem::path& path);

}  // namespace hogel
