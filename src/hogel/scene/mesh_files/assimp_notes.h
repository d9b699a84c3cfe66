// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

namespace hogel::scene::mesh_files {

/// What assimp read of a file that hogel does not show; a note each.
/// @param materials  whether materials are looked at, which for some formats are read elsewhere
std::vector<std::string> notes_of(const aiScene& scene, bool materials);

}  // namespace hogel::scene::mesh_files
