// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/scene.h"
#include "hogel/scene/edges.h"

namespace hogel::scene::mesh_files {

/// Flips triangles for consistent neighbours. A connected surface takes the outward orientation if closed, otherwise
/// that of most of its area. Leaves one-sided surfaces (Möbius strip). Returns the number of flipped triangles.
/// @param edges  sorted_edges() of the unmodified mesh
std::size_t orient_neighbors(Mesh& mesh, const std::vector<TriangleEdge>& edges);

/// Result of turn_inside_out().
struct Sides {
    bool is_body = false;    ///< nearly all of the mesh encloses volumes
    std::size_t bodies = 0;  ///< surfaces that enclose a volume
    std::size_t turned = 0;  ///< those with flipped triangles or normals
};

/// Flips closed surfaces that face inwards, as in some scans: their triangles and consistent normals. Also flips
/// normals that alone face inwards. Each connected surface is decided separately; open surfaces are decided jointly.
/// @param edges  sorted_edges() of the mesh, before or after orient_neighbors()
Sides turn_inside_out(Mesh& mesh, const std::vector<TriangleEdge>& edges);

}  // namespace hogel::scene::mesh_files
