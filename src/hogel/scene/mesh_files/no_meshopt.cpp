// SPDX-License-Identifier: Apache-2.0
// Replaces meshopt.cpp in a build without libmeshoptimizer; unpack_views() throws before.
#include "hogel/scene/mesh_files/meshopt.h"

namespace hogel::scene::mesh_files {

bool unpack(const PackedView& /*view*/, std::vector<unsigned char>& /*to*/) { return false; }

}  // namespace hogel::scene::mesh_files
