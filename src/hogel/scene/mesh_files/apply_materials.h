// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene/mesh_files/gltf_materials.h"
#include "hogel/scene/mesh_files/materials.h"
#include "hogel/scene/mesh_files/transfer.h"

namespace hogel::scene::mesh_files {

/// Gives a mesh that assimp read the material that the document has for it, with its textures.
void apply_materials(const GltfMaterials& looks, ImportedMesh& part, Textures& textures);

}  // namespace hogel::scene::mesh_files
