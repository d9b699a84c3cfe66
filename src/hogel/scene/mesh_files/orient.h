// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/scene.h"
#include "hogel/scene/edges.h"

namespace hogel::scene::mesh_files {

/// Turns triangles so that neighbours face the same side of their surface, as many programs do not care to write them.
/// A connected surface takes the side that more of it has or, if it encloses a volume, the outer one. One that has only
/// one side, as Möbius' strip, stays as it is, and so does one whose neighbours agree. Returns how many were turned.
/// @param edges  sorted_edges() of the mesh as it was
std::size_t orient_neighbors(Mesh& mesh, const std::vector<TriangleEdge>& edges);

/// What turn_inside_out() finds.
struct Sides {
    bool is_body = false;    ///< nearly all of the mesh encloses volumes
    std::size_t bodies = 0;  ///< surfaces that enclose a volume
    std::size_t turned = 0;  ///< those of them of which triangles or normals were turned
};

/// Turns bodies whose triangles face inwards, as some programs write scans: their corners, and normals that agree with
/// them. Normals of a body that face inwards alone are turned as well. Each connected surface is decided by itself;
/// those that enclose no volume alone, together.
/// @param edges  sorted_edges() of the mesh, before or after orient_neighbors()
Sides turn_inside_out(Mesh& mesh, const std::vector<TriangleEdge>& edges);

}  // namespace hogel::scene::mesh_files
