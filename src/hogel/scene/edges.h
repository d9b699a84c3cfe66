// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hogel/scene.h"

namespace hogel::scene {

/// An edge of a triangle between two vertices, each of which is the lowest-numbered one at its position. Corner k of
/// triangle t has the number 3 t + k.
struct TriangleEdge {
    std::uint32_t low, high;        ///< the vertices
    std::uint32_t at_low, at_high;  ///< the triangle's corners there

    std::uint32_t triangle() const { return at_low / 3; }
    /// Whether the triangle's outline goes from `low` to `high`. Two triangles of one surface differ in that.
    bool is_upward() const { return (at_low % 3 + 1) % 3 == at_high % 3; }
    bool joins_the_same(const TriangleEdge& other) const { return low == other.low && high == other.high; }
};

/// Steps of loops over triangles between two checks for a stop.
constexpr std::size_t between_checks = 1 << 16;

/// The edges of all triangles in the order of low, high and at_low, so that those between the same positions are next
/// to each other.
std::vector<TriangleEdge> sorted_edges(const Mesh& mesh);

/// Gives a mesh the normals of add_missing_normals().
/// @param edges  sorted_edges() of the mesh
void add_normals(Mesh& mesh, const std::vector<TriangleEdge>& edges, double crease);

}  // namespace hogel::scene
