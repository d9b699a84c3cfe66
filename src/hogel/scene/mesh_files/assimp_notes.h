// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

namespace hogel::scene::mesh_files {

/// Returns a note for each feature of a file that assimp read but hogel does not show.
/// @param materials  whether to include materials, which are read elsewhere for some formats
std::vector<std::string> notes_of(const aiScene& scene, bool materials);

}  // namespace hogel::scene::mesh_files
