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

/// Connected triangles with their relative orientation: a union-find forest with signed links.
class Surfaces {
  public:
    explicit Surfaces(std::size_t triangles) : links_(triangles) {
        for (std::uint32_t i = 0; i < triangles; ++i) links_[i].to = i;
    }
    struct Link {
        std::uint32_t to = 0;
        bool is_turned = false;     ///< relative to `to`
        bool has_one_side = false;  ///< roots only
        bool is_mixed = false;      ///< roots only: some triangles are inconsistent with their neighbours
    };

    Link find(std::uint32_t triangle) {
        bool turned = false;
        std::uint32_t node = triangle;
        for (; links_[node].to != node; node = links_[node].to) turned ^= links_[node].is_turned;
        const std::uint32_t root = node;
        // Path compression.
        for (bool parity = turned; links_[triangle].to != triangle;) {
            Link& link = links_[triangle];
            const std::uint32_t next = link.to;
            const bool after = parity ^ link.is_turned;
            link.to = root, link.is_turned = parity;
            triangle = next, parity = after;
        }
        return {root, turned, links_[root].has_one_side, links_[root].is_mixed};
    }
    void join(std::uint32_t a, std::uint32_t b, bool opposite) {
        const Link link_a = find(a), link_b = find(b);
        Link& root = links_[link_a.to];
        root.is_mixed |= opposite || link_b.is_mixed;
        if (link_a.to == link_b.to) {
            root.has_one_side |= (link_a.is_turned ^ link_b.is_turned) != opposite;
            return;
        }
        root.has_one_side |= link_b.has_one_side;
        links_[link_b.to] = {link_a.to, (link_a.is_turned ^ link_b.is_turned) != opposite, false, false};
    }

  private:
    std::vector<Link> links_;
};

/// Calls `visit` with the two triangles of every edge of exactly two, and whether their orientations differ.
template <class Visit>
void for_neighbors(const std::vector<TriangleEdge>& edges, const Visit& visit) {
    for (std::size_t first = 0, end = 0, n = 0; first < edges.size(); first = end) {
        if (n++ % between_checks == 0) core::throw_if_stopped();
        while (end < edges.size() && edges[end].has_same_ends(edges[first])) ++end;
        if (end - first == 2 && edges[first].low != edges[first].high)
            visit(edges[first].triangle(), edges[first + 1].triangle(),
                  edges[first].is_upward() == edges[first + 1].is_upward());
    }
}

/// Sums over the triangles of a surface, all oriented as its root.
struct Sums {
    Vec3 open{};  ///< vector area
    double area = 0, turned_area = 0, volume = 0;
    double agreement = 0;  ///< of vertex normals with face areas; negative: opposite sides

    Sums& operator+=(const Sums& other) {
        open += other.open;
        area += other.area;
        turned_area += other.turned_area;
        volume += other.volume;
        agreement += other.agreement;
        return *this;
    }
    /// Returns whether the surface is closed, except for small holes, and encloses a volume.
    bool is_body() const {
        constexpr double max_open = 0.1;  // relative to the area; an open box has one fifth
        // Relative to the area to the power 3/2: 0.094 for a sphere, 0.007 for a plate fifty times as wide as thick.
        constexpr double min_volume = 0.003;
        return std::abs(volume) > min_volume * std::pow(area, 1.5) && length(open) <= max_open * area;
    }
    bool is_turned() const { return is_body() && volume < 0; }
    bool has_normals_inwards() const { return is_body() && agreement * volume < 0; }
};

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
        const bool flipped = sum.is_body() ? sum.volume < 0 : 2 * sum.turned_area > sum.area;
        if (link.is_turned == flipped) continue;
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        ++turned;
    }
    return turned;
}

namespace {

/// Flips the triangles and normals of surfaces according to their sums.
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
    // Open surfaces may jointly be the sides of a body.
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
