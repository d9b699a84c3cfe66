// SPDX-License-Identifier: Apache-2.0
// Replaces the folder mesh_files in a build without assimp.
#include "hogel/core/part.h"
#include "hogel/scene/pictures.h"

namespace hogel::scene {

Scene import_mesh(const std::filesystem::path& path, const ImportOptions&) {
    core::refuse_without("assimp", path.string());
}

}  // namespace hogel::scene
