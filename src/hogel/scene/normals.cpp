// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "hogel/scene.h"
#include "hogel/scene/edges.h"
#include "hogel/scene/vertices.h"

namespace hogel {
namespace {

using Index = std::uint32_t;

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

/// Twice the area times the unit normal of every triangle.
std::vector<Vec3> area_normals(const Mesh& mesh) {
    std::vector<Vec3> normals;
    normals.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles)
        normals.push_back(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
    return normals;
}

/// Calls `visit` with every two edges between the same positions that follow each other.
template <class Visit>
void for_neighbors(const std::vector<scene::TriangleEdge>& edges, const Visit& visit) {
    for (std::size_t i = 1; i < edges.size(); ++i)
        if (edges[i - 1].joins_the_same(edges[i])) visit(edges[i - 1], edges[i]);
}

/// Which triangles are folded: decimated scans have some that lie with their back upwards on a surface, between
/// neighbours that all face the other way and agree with each other. A fold is a third of the size of its neighbours.
std::vector<char> find_folds(const std::vector<scene::TriangleEdge>& edges, const std::vector<Vec3>& faces) {
    constexpr double agreeing = 0.8;  // length of the mean of unit normals: within about 37 degrees of it
    struct Neighbors {
        Vec3 sum;
        std::uint32_t count = 0, opposite = 0;
    };
    std::vector<Neighbors> neighbors(faces.size());
    for_neighbors(edges, [&](const scene::TriangleEdge& a, const scene::TriangleEdge& b) {
        const Vec3 na = faces[a.triangle()], nb = faces[b.triangle()];
        const double la = length(na), lb = length(nb);
        if (!(la > 0 && lb > 0)) return;
        const bool opposite = dot(na, nb) < 0;
        const auto add = [&](std::uint32_t triangle, Vec3 unit) {
            Neighbors& of = neighbors[triangle];
            of.sum += unit;
            ++of.count;
            of.opposite += opposite ? 1 : 0;
        };
        add(a.triangle(), nb / lb);
        add(b.triangle(), na / la);
    });
    std::vector<char> folds(faces.size());
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const Neighbors& of = neighbors[t];
        folds[t] = of.count > 1 && of.opposite == of.count && length(of.sum) > agreeing * of.count;
    }
    return folds;
}

/// Joins the corners of neighbouring triangles that meet at an angle of at most `crease` radians, and those of folds
/// with all neighbours.
Groups smoothing_groups(const std::vector<scene::TriangleEdge>& edges, const std::vector<Vec3>& faces,
                        const std::vector<char>& folds, double crease) {
    Groups groups(3 * faces.size());
    const double cosine = std::cos(crease);
    for_neighbors(edges, [&](const scene::TriangleEdge& a, const scene::TriangleEdge& b) {
        if (!folds[a.triangle()] && !folds[b.triangle()]) {
            const Vec3 na = faces[a.triangle()], nb = faces[b.triangle()];
            if (dot(na, nb) <= 0 && cosine > 0) return;
            const double both = length(na) * length(nb);
            if (both == 0 || dot(na, nb) < cosine * both) return;
        }
        groups.join(a.at_low, b.at_low);
        groups.join(a.at_high, b.at_high);
    });
    return groups;
}

void add_normals(Mesh& mesh, double crease) {
    const std::vector<Vec3> faces = area_normals(mesh);
    const std::vector<scene::TriangleEdge> edges = scene::sorted_edges(mesh);
    const std::vector<char> folds = find_folds(edges, faces);
    Groups groups = smoothing_groups(edges, faces, folds, crease);
    std::vector<Vec3> sums(3 * mesh.triangles.size());
    for (Index corner = 0; corner < sums.size(); ++corner)
        if (!folds[corner / 3]) sums[groups.find(corner)] += faces[corner / 3];

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
