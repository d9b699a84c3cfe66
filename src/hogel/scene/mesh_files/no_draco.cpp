// SPDX-License-Identifier: Apache-2.0
// Replaces draco.cpp in a build without libdraco; unpack_draco() throws before.
#include "hogel/scene/mesh_files/draco.h"

namespace hogel::scene::mesh_files {

std::optional<std::vector<std::string>> decode(const DracoMesh& /*mesh*/) { return std::nullopt; }

}  // namespace hogel::scene::mesh_files
