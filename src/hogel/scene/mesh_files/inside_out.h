// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

/// Turns a body whose triangles face inwards, as some programs write scans: their corners, and normals that agree with
/// them. A body is a mesh that is closed but for small holes and encloses a volume. Returns whether it was turned.
bool turn_inside_out(Mesh& mesh);

}  // namespace hogel::scene::mesh_files
