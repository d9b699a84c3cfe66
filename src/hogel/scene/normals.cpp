// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "hogel/core/stop_scope.h"
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
    /// Returns the lowest-numbered corner of each group. Parents precede children, so that one pass suffices.
    std::vector<Index> all() && {
        for (Index& parent : parent_) parent = parent_[parent];
        return std::move(parent_);
    }

  private:
    std::vector<Index> parent_;
};

/// Returns twice the area times the unit normal of every triangle.
std::vector<Vec3> area_normals(const Mesh& mesh) {
    std::vector<Vec3> normals;
    normals.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles)
        normals.push_back(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
    return normals;
}

/// Calls `visit` with consecutive pairs of edges between the same positions.
template <class Visit>
void for_neighbors(const std::vector<scene::TriangleEdge>& edges, const Visit& visit) {
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (i % scene::between_checks == 0) core::throw_if_stopped();
        if (edges[i - 1].has_same_ends(edges[i])) visit(edges[i - 1], edges[i]);
    }
}

/// Finds folded triangles of decimated scans: upside down between consistent neighbours. Returns an empty vector if no
/// triangle has two opposite neighbours, as in most meshes.
std::vector<char> find_folds(const std::vector<scene::TriangleEdge>& edges, const std::vector<Vec3>& faces) {
    constexpr double agreeing = 0.8;  // minimum length of the mean unit normal: within about 37 degrees
    std::vector<std::uint8_t> opposite(faces.size());
    for_neighbors(edges, [&](const scene::TriangleEdge& a, const scene::TriangleEdge& b) {
        if (!(dot(faces[a.triangle()], faces[b.triangle()]) < 0)) return;
        for (const std::uint32_t t : {a.triangle(), b.triangle()})
            opposite[t] = static_cast<std::uint8_t>(std::min(opposite[t] + 1, 255));
    });
    if (std::ranges::none_of(opposite, [](int count) { return count > 1; })) return {};
    struct Neighbors {
        Vec3 sum;
        int count = 0;
    };
    std::vector<Neighbors> neighbors(faces.size());
    const auto add = [&](std::uint32_t triangle, Vec3 face) {
        if (opposite[triangle] < 2 || !(length(face) > 0)) return;
        neighbors[triangle].sum += normalize(face);
        ++neighbors[triangle].count;
    };
    for_neighbors(edges, [&](const scene::TriangleEdge& a, const scene::TriangleEdge& b) {
        add(a.triangle(), faces[b.triangle()]);
        add(b.triangle(), faces[a.triangle()]);
    });
    std::vector<char> folds(faces.size());
    for (std::size_t t = 0; t < faces.size(); ++t)
        folds[t] = opposite[t] > 1 && opposite[t] == neighbors[t].count &&
                   length(neighbors[t].sum) > agreeing * neighbors[t].count;
    return folds;
}

/// Joins the corners of neighbours that meet at up to `crease` radians, and those of folds with all neighbours.
std::vector<Index> smoothing_groups(const std::vector<scene::TriangleEdge>& edges, const std::vector<Vec3>& faces,
                                    const std::vector<char>& folds, double crease) {
    Groups groups(3 * faces.size());
    const double cosine = std::cos(crease);
    std::vector<double> lengths;
    lengths.reserve(faces.size());
    for (const Vec3& face : faces) lengths.push_back(length(face));
    for_neighbors(edges, [&](const scene::TriangleEdge& a, const scene::TriangleEdge& b) {
        if (folds.empty() || (!folds[a.triangle()] && !folds[b.triangle()])) {
            const Vec3 na = faces[a.triangle()], nb = faces[b.triangle()];
            if (dot(na, nb) <= 0 && cosine > 0) return;
            const double both = lengths[a.triangle()] * lengths[b.triangle()];
            if (both == 0 || dot(na, nb) < cosine * both) return;
        }
        groups.join(a.low_corner, b.low_corner);
        groups.join(a.high_corner, b.high_corner);
    });
    return std::move(groups).all();
}

}  // namespace

void scene::add_normals(Mesh& mesh, const std::vector<TriangleEdge>& edges, double crease) {
    const std::vector<Vec3> faces = area_normals(mesh);
    const std::vector<char> folds = find_folds(edges, faces);
    const std::vector<Index> groups = smoothing_groups(edges, faces, folds, crease);
    std::vector<Vec3> sums(3 * mesh.triangles.size());
    for (Index corner = 0; corner < sums.size(); ++corner)
        if (folds.empty() || !folds[corner / 3]) sums[groups[corner]] += faces[corner / 3];

    // A vertex keeps its index for the first group and is copied for each further group.
    constexpr Index none = ~Index{0};
    struct Use {
        Index group = none, next_copy = none;
    };
    std::vector<Use> uses(mesh.positions.size());
    mesh.normals.assign(mesh.positions.size(), Vec3{0, 0, 1});
    for (Index corner = 0; corner < sums.size(); ++corner) {
        if (corner % scene::between_checks == 0) core::throw_if_stopped();
        const Index group = groups[corner];
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

void add_missing_normals(Scene& scene, double crease) {
    for (Mesh& mesh : scene.meshes)
        if (mesh.normals.empty()) scene::add_normals(mesh, scene::sorted_edges(mesh), crease);
}

}  // namespace hogel
