// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hogel/scene.h"

namespace hogel::scene {

/// An edge; vertices are the lowest-numbered ones at their positions. Corner k of triangle t is number 3 t + k.
struct TriangleEdge {
    std::uint32_t low, high;                ///< the vertices
    std::uint32_t low_corner, high_corner;  ///< the triangle's corners at these vertices

    std::uint32_t triangle() const { return low_corner / 3; }
    /// Returns whether the triangle's outline goes from `low` to `high`; opposite for consistently oriented neighbours.
    bool is_upward() const { return (low_corner % 3 + 1) % 3 == high_corner % 3; }
    bool has_same_ends(const TriangleEdge& other) const { return low == other.low && high == other.high; }
};

/// Loop steps between two stop checks.
constexpr std::size_t between_checks = 1 << 16;

/// Returns all edges sorted by low, high and low_corner, so that equal ones are adjacent.
std::vector<TriangleEdge> sorted_edges(const Mesh& mesh);

/// Adds normals as add_missing_normals() does. `edges` are sorted_edges() of the mesh.
void add_normals(Mesh& mesh, const std::vector<TriangleEdge>& edges, double crease);

}  // namespace hogel::scene
