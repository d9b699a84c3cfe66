// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene/mesh_files/gltf_materials.h"
#include "hogel/scene/mesh_files/materials.h"
#include "hogel/scene/mesh_files/transfer.h"

namespace hogel::scene::mesh_files {

/// Assigns the material of the glTF document, with its textures, to a mesh read by assimp.
void apply_materials(const GltfMaterials& materials, ImportedMesh& part, Textures& textures);

}  // namespace hogel::scene::mesh_files
