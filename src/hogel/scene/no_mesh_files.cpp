// SPDX-License-Identifier: Apache-2.0
// Replaces the folder mesh_files in a build without assimp.
#include "hogel/core/part.h"
#include "hogel/scene.h"

namespace hogel {

Scene import_scene(const std::filesystem::path& path, const Progress&, const ImportOptions&) {
    core::refuse_without("assimp", path.string());
}

}  // namespace hogel
