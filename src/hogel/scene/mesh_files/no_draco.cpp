// SPDX-License-Identifier: Apache-2.0
// In a build without libdraco; unpack_draco() refuses before.
#include "hogel/scene/mesh_files/draco.h"

namespace hogel::scene::mesh_files {

std::optional<std::vector<std::string>> decode(const DracoMesh& /*mesh*/) { return std::nullopt; }

}  // namespace hogel::scene::mesh_files
