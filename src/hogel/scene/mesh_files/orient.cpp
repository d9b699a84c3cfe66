// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/orient.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "hogel/core/stop_scope.h"

namespace hogel::scene::mesh_files {
namespace {

/// Triangles that are connected, and which of them face the other way than the one that stands for them all: a
/// union-find forest whose links have a sign.
class Surfaces {
  public:
    explicit Surfaces(std::size_t triangles) : links_(triangles) {
        for (std::uint32_t i = 0; i < triangles; ++i) links_[i].to = i;
    }
    struct Link {
        std::uint32_t to = 0;
        bool is_turned = false;     ///< relative to that one
        bool has_one_side = false;  ///< of one that stands for itself
        bool is_mixed = false;      ///< the same: some of its triangles face the other way than their neighbours
    };

    Link find(std::uint32_t triangle) {
        bool turned = false;
        std::uint32_t at = triangle;
        for (; links_[at].to != at; at = links_[at].to) turned ^= links_[at].is_turned;
        const std::uint32_t root = at;
        // The path becomes as short as it can be.
        for (bool rest = turned; links_[triangle].to != triangle;) {
            Link& link = links_[triangle];
            const std::uint32_t next = link.to;
            const bool after = rest ^ link.is_turned;
            link.to = root, link.is_turned = rest;
            triangle = next, rest = after;
        }
        return {root, turned, links_[root].has_one_side, links_[root].is_mixed};
    }
    void join(std::uint32_t a, std::uint32_t b, bool opposite) {
        const Link of_a = find(a), of_b = find(b);
        Link& root = links_[of_a.to];
        root.is_mixed |= opposite || of_b.is_mixed;
        if (of_a.to == of_b.to) {
            root.has_one_side |= (of_a.is_turned ^ of_b.is_turned) != opposite;
            return;
        }
        root.has_one_side |= of_b.has_one_side;
        links_[of_b.to] = {of_a.to, (of_a.is_turned ^ of_b.is_turned) != opposite, false, false};
    }

  private:
    std::vector<Link> links_;
};

/// Calls `visit` with the triangles on both sides of every edge of just two, and whether they face other sides.
template <class Visit>
void for_neighbors(const std::vector<TriangleEdge>& edges, const Visit& visit) {
    for (std::size_t first = 0, end = 0, n = 0; first < edges.size(); first = end) {
        if (n++ % between_checks == 0) core::throw_if_stopped();
        while (end < edges.size() && edges[end].joins_the_same(edges[first])) ++end;
        if (end - first == 2 && edges[first].low != edges[first].high)
            visit(edges[first].triangle(), edges[first + 1].triangle(),
                  edges[first].is_upward() == edges[first + 1].is_upward());
    }
}

/// What the triangles of one surface sum up to, all turned as the one that stands for them.
struct Sums {
    Vec3 open{};  ///< areas as vectors
    double area = 0, turned_area = 0, volume = 0;
    double agreement = 0;  ///< of the normals of vertices with the areas; below zero: they point to the other side

    Sums& operator+=(const Sums& other) {
        open += other.open;
        area += other.area;
        turned_area += other.turned_area;
        volume += other.volume;
        agreement += other.agreement;
        return *this;
    }
    /// Whether the surface is that of a body: closed but for small holes, and around a volume.
    bool is_body() const {
        constexpr double max_open = 0.1;  // by the area; an open box has a fifth of its area left
        // By the area to 3/2: 0.094 for a sphere, 0.007 for a plate fifty times as wide as thick.
        constexpr double min_volume = 0.003;
        return std::abs(volume) > min_volume * std::pow(area, 1.5) && length(open) <= max_open * area;
    }
    bool is_turned() const { return is_body() && volume < 0; }
    bool has_normals_inwards() const { return is_body() && agreement * volume < 0; }
};

/// The surface that each triangle belongs to.
std::vector<Surfaces::Link> find_surfaces(Surfaces& surfaces, std::size_t triangles) {
    std::vector<Surfaces::Link> links(triangles);
    for (std::uint32_t t = 0; t < triangles; ++t) {
        if (t % between_checks == 0) core::throw_if_stopped();
        links[t] = surfaces.find(t);
    }
    return links;
}

std::vector<Sums> sum_surfaces(const Mesh& mesh, const std::vector<Surfaces::Link>& links) {
    std::vector<Sums> sums(links.size());
    const Vec3 origin = mesh.positions[mesh.triangles[0][0]];
    for (std::size_t t = 0; t < links.size(); ++t) {
        if (t % between_checks == 0) core::throw_if_stopped();
        const auto& [a, b, c] = mesh.triangles[t];
        const Vec3 p = mesh.positions[a] - origin, q = mesh.positions[b] - origin, r = mesh.positions[c] - origin;
        const Vec3 front = 0.5 * cross(q - p, r - p);
        const double sign = links[t].is_turned ? -1 : 1;
        Sums& sum = sums[links[t].to];
        sum.open += sign * front;
        sum.area += length(front);
        if (links[t].is_turned) sum.turned_area += length(front);
        sum.volume += sign * dot(p, cross(q, r)) / 6;
        if (!mesh.normals.empty())
            sum.agreement += sign * dot(front, mesh.normals[a] + mesh.normals[b] + mesh.normals[c]);
    }
    return sums;
}

}  // namespace

std::size_t orient_neighbors(Mesh& mesh, const std::vector<TriangleEdge>& edges) {
    bool any = false;
    for_neighbors(edges, [&](std::uint32_t, std::uint32_t, bool opposite) { any |= opposite; });
    if (!any) return 0;
    Surfaces surfaces(mesh.triangles.size());
    for_neighbors(edges, [&](std::uint32_t a, std::uint32_t b, bool opposite) { surfaces.join(a, b, opposite); });
    const std::vector<Surfaces::Link> links = find_surfaces(surfaces, mesh.triangles.size());
    const std::vector<Sums> sums = sum_surfaces(mesh, links);
    std::size_t turned = 0;
    for (std::size_t t = 0; t < links.size(); ++t) {
        const Surfaces::Link& link = links[t];
        const Sums& sum = sums[link.to];
        if (!link.is_mixed || link.has_one_side) continue;
        const bool other = sum.is_body() ? sum.volume < 0 : 2 * sum.turned_area > sum.area;
        if (link.is_turned == other) continue;
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        ++turned;
    }
    return turned;
}

namespace {

/// Turns the triangles and the normals of the surfaces whose sums say so.
void turn_surfaces(Mesh& mesh, const std::vector<Surfaces::Link>& links, const std::vector<Sums>& sums) {
    std::vector<bool> has_normal_inwards(mesh.normals.size());
    for (std::size_t t = 0; t < links.size(); ++t) {
        const Sums& sum = sums[links[t].to];
        if (sum.has_normals_inwards() && !mesh.normals.empty())
            for (const std::uint32_t vertex : mesh.triangles[t]) has_normal_inwards[vertex] = true;
        if (sum.is_turned()) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    }
    for (std::size_t i = 0; i < has_normal_inwards.size(); ++i)
        if (has_normal_inwards[i]) mesh.normals[i] = -mesh.normals[i];
}

}  // namespace

Sides turn_inside_out(Mesh& mesh, const std::vector<TriangleEdge>& edges) {
    if (mesh.triangles.empty()) return {};
    Surfaces surfaces(mesh.triangles.size());
    for_neighbors(edges, [&](std::uint32_t a, std::uint32_t b, bool) { surfaces.join(a, b, false); });
    const std::vector<Surfaces::Link> links = find_surfaces(surfaces, mesh.triangles.size());
    std::vector<Sums> sums = sum_surfaces(mesh, links);
    // Surfaces that are no bodies by themselves may be the sides of one.
    Sums sides, bodies;
    for (const Sums& sum : sums) (sum.is_body() ? bodies : sides) += sum;
    Sides result;
    bool has_sides = false;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (sums[i].area == 0) continue;
        if (!sums[i].is_body() && sides.is_body()) {
            sums[i] = sides;
            if (std::exchange(has_sides, true)) continue;  // they are one body
        }
        if (!sums[i].is_body()) continue;
        ++result.bodies;
        if (sums[i].is_turned() || (!mesh.normals.empty() && sums[i].has_normals_inwards())) ++result.turned;
    }
    turn_surfaces(mesh, links, sums);
    constexpr double min_share = 0.9;  // of the area
    Sums all = bodies;
    all += sides;
    result.is_body = sides.is_body() || bodies.area >= min_share * all.area || all.is_body();
    return result;
}

}  // namespace hogel::scene::mesh_files
