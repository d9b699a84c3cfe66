// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

/// Whether a surface is that of a body: closed but for small holes, and around a volume.
/// @param open    the sum of its areas as vectors, which is zero for a closed surface
/// @param area    of all triangles
/// @param volume  that it encloses, below zero if its front is inside
bool is_body(Vec3 open, double area, double volume);

/// What turn_inside_out() finds.
struct Sides {
    bool is_body = false;  ///< is_body()
    bool turned = false;   ///< whether triangles or normals were turned
};

/// Turns a body whose triangles face inwards, as some programs write scans: their corners, and normals that agree with
/// them. Normals of a body that face inwards alone are turned as well.
Sides turn_inside_out(Mesh& mesh);

}  // namespace hogel::scene::mesh_files
