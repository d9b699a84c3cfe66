// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace hogel::scene::mesh_files {

/// Corrects the triangle count of a binary STL file, on which assimp relies, if it is 0, unknown or too small. Throws
/// Error(bad_input) if there are fewer triangles than announced. `notes` receives a line for each correction.
std::string with_counted_triangles(const std::string& file, std::string bytes, std::vector<std::string>& notes);

}  // namespace hogel::scene::mesh_files
