// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "hogel/scene.h"
#include "hogel/scene/vertices.h"

namespace hogel {
namespace {

using Index = std::uint32_t;

/// For every vertex the lowest-numbered vertex at the same position.
std::vector<Index> weld(const std::vector<Vec3>& positions) {
    std::vector<Index> order(positions.size()), welded(positions.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index i, Index j) {
        const Vec3 &a = positions[i], &b = positions[j];
        return std::tie(a.x, a.y, a.z, i) < std::tie(b.x, b.y, b.z, j);
    });
    for (std::size_t k = 0; k < order.size(); ++k)
        welded[order[k]] = k > 0 && positions[order[k]] == positions[order[k - 1]] ? welded[order[k - 1]] : order[k];
    return welded;
}

/// Sets of triangle corners that share a normal, as a union-find forest.
class Groups {
  public:
    explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
    Index find(Index i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(Index i, Index j) {
        i = find(i), j = find(j);
        parent_[std::max(i, j)] = std::min(i, j);
    }

  private:
    std::vector<Index> parent_;
};

/// An edge of a triangle between two welded vertices; `at_low` is the triangle's corner at the lower-numbered one.
struct Edge {
    Index low, high, at_low, at_high;
};

std::vector<Edge> sorted_edges(const Mesh& mesh, const std::vector<Index>& welded) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            Edge edge{welded[mesh.triangles[t][k]], welded[mesh.triangles[t][next]], static_cast<Index>(3 * t + k),
                      static_cast<Index>(3 * t + next)};
            if (edge.low > edge.high) edge = {edge.high, edge.low, edge.at_high, edge.at_low};
            edges.push_back(edge);
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.at_low) < std::tie(b.low, b.high, b.at_low);
    });
    return edges;
}

/// Twice the area times the unit normal of every triangle.
std::vector<Vec3> area_normals(const Mesh& mesh) {
    std::vector<Vec3> normals;
    normals.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles)
        normals.push_back(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
    return normals;
}

/// Joins the corners of neighbouring triangles that meet at an angle of at most `crease` radians.
Groups smoothing_groups(const Mesh& mesh, const std::vector<Vec3>& faces, double crease) {
    const std::vector<Edge> edges = sorted_edges(mesh, weld(mesh.positions));
    Groups groups(3 * mesh.triangles.size());
    const double cosine = std::cos(crease);
    for (std::size_t i = 1; i < edges.size(); ++i) {
        const Edge &a = edges[i - 1], &b = edges[i];
        if (a.low != b.low || a.high != b.high) continue;
        const Vec3 na = faces[a.at_low / 3], nb = faces[b.at_low / 3];
        if (dot(na, nb) <= 0 && cosine > 0) continue;
        const double both = length(na) * length(nb);
        if (both == 0 || dot(na, nb) < cosine * both) continue;
        groups.join(a.at_low, b.at_low);
        groups.join(a.at_high, b.at_high);
    }
    return groups;
}

void add_normals(Mesh& mesh, double crease) {
    const std::vector<Vec3> faces = area_normals(mesh);
    Groups groups = smoothing_groups(mesh, faces, crease);
    std::vector<Vec3> sums(3 * mesh.triangles.size());
    for (Index corner = 0; corner < sums.size(); ++corner) sums[groups.find(corner)] += faces[corner / 3];

    // A vertex keeps its index for the first group that uses it and is copied for every further group.
    constexpr Index none = ~Index{0};
    struct Use {
        Index group = none, next_copy = none;
    };
    std::vector<Use> uses(mesh.positions.size());
    mesh.normals.assign(mesh.positions.size(), Vec3{0, 0, 1});
    for (Index corner = 0; corner < sums.size(); ++corner) {
        const Index group = groups.find(corner);
        const double size = length(sums[group]);
        const Vec3 normal = size > 0 ? sums[group] / size : Vec3{0, 0, 1};
        Index& vertex = mesh.triangles[corner / 3][corner % 3];
        Index i = vertex;
        while (uses[i].group != group && uses[i].group != none && uses[i].next_copy != none) i = uses[i].next_copy;
        if (uses[i].group == none) {
            uses[i].group = group;
            mesh.normals[i] = normal;
        } else if (uses[i].group != group) {
            const Index copy = scene::add_copy_of_vertex(mesh, vertex);
            mesh.normals[copy] = normal;
            uses[i].next_copy = copy;
            uses.push_back({group, none});
            i = copy;
        }
        vertex = i;
    }
}

}  // namespace

void add_missing_normals(Scene& scene, double crease) {
    for (Mesh& mesh : scene.meshes)
        if (mesh.normals.empty()) add_normals(mesh, crease);
}

}  // namespace hogel
