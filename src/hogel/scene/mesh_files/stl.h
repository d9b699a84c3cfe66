// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace hogel::scene::mesh_files {

/// The bytes of an STL file, with the number of triangles that it holds where its header announces none or fewer than
/// whole triangles follow. assimp refuses such a file. Throws Error(bad_input) for binary data with fewer triangles
/// than announced.
/// @param notes  receives a line for each such mistake
std::string with_counted_triangles(const std::string& file, std::string bytes, std::vector<std::string>& notes);

}  // namespace hogel::scene::mesh_files
