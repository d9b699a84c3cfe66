// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

/// Turns triangles so that neighbours face the same side of their surface, as many programs do not care to write them.
/// A connected surface takes the side that more of it has or, if it encloses a volume, the outer one. One that has only
/// one side, as Möbius' strip, stays as it is, and so does one whose neighbours agree. Returns how many were turned.
std::size_t orient_neighbors(Mesh& mesh);

}  // namespace hogel::scene::mesh_files
