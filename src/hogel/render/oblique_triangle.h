// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "hogel/render/sample_store.h"

namespace hogel::render {

inline std::array<Vec3, 3> corners_of(const ShadedScene& scene, std::size_t index) {
    const auto& [a, b, c] = scene.triangles[index].vertices;
    return {scene.positions[a], scene.positions[b], scene.positions[c]};
}

/// Triangle projected along one direction (U, V) onto the hologram plane, in which rays of this direction are points.
///
/// The renderers that collect candidate samples instead of testing every sample (`simplex`, `simploid`, `simplex3d`,
/// `oblique`, `mvr`) use this class to test whether and where a ray meets a triangle. The result depends only on the
/// ray and the triangle, not on how, how often and in which region a sample was found.
///
/// The edge functions of docs/notation.md, section 2, are evaluated in the ray's frame: E = p_A × p_B with p = (x − Uζ
/// − s, y − Vζ − t). A rounded difference of two rounded products may be zero but never has the wrong sign, so
/// triangles that share vertices tile the plane. A ray through an edge belongs to the triangle to the left of the edge
/// in the plane (above the edge if it is horizontal), as if the ray were shifted slightly to the left and, much less,
/// upwards.
class ObliqueTriangle {
  public:
    /// Projects along the slopes U = dx/dζ and V = dy/dζ.
    ObliqueTriangle(const ShadedScene& scene, std::size_t index, double U, double V)
        : ObliqueTriangle(corners_of(scene, index), scene.fronts_only, U, V) {}
    ObliqueTriangle(const std::array<Vec3, 3>& corners, bool fronts_only, double U, double V)
        : fronts_only_(fronts_only) {
        for (std::size_t i = 0; i < 3; ++i) {
            depth_[i] = -corners[i].z;
            s_[i] = corners[i].x - U * depth_[i];
            t_[i] = corners[i].y - V * depth_[i];
        }
    }

    /// Projects along the ray in column u and row v of a light field's directions, on any face.
    ObliqueTriangle(const ShadedScene& scene, std::size_t index, const LightFieldGrid& grid, double u, double v)
        : ObliqueTriangle(scene, index, grid.direction_of(grid.u(u), grid.v(v))) {}

    const std::array<double, 3>& s() const { return s_; }
    const std::array<double, 3>& t() const { return t_; }

    struct Hit {
        std::array<double, 3> weights{};  ///< of the vertices; their sum is 1
        double depth = std::numeric_limits<double>::infinity();

        explicit operator bool() const { return depth < std::numeric_limits<double>::infinity(); }
    };

    /// Returns the point where the ray through (s, t) meets the triangle, or a false Hit.
    Hit at(double s, double t) const {
        std::array<double, 3> x, y, w;
        for (std::size_t i = 0; i < 3; ++i) {
            x[i] = s_[i] - s;
            y[i] = t_[i] - t;
        }
        w[0] = x[1] * y[2] - y[1] * x[2];
        w[1] = x[2] * y[0] - y[2] * x[0];
        w[2] = x[0] * y[1] - y[0] * x[1];
        const double area = w[0] + w[1] + w[2];
        if (area == 0 || (area < 0 && fronts_only_)) return {};
        const double side = area > 0 ? 1 : -1;
        for (std::size_t i = 0; i < 3; ++i) {
            if (side * w[i] < 0) return {};
            if (w[i] == 0 && !owns_edge(x[(i + 1) % 3], y[(i + 1) % 3], x[(i + 2) % 3], y[(i + 2) % 3], side))
                return {};
        }
        return {{w[0] / area, w[1] / area, w[2] / area},
                (w[0] * depth_[0] + w[1] * depth_[1] + w[2] * depth_[2]) / area};
    }

  private:
    ObliqueTriangle(const ShadedScene& scene, std::size_t index, Vec3 direction)
        : ObliqueTriangle(scene, index, direction.x / direction.z, direction.y / direction.z) {}

    // Returns whether a triangle to the left of edge A → B (right for side = −1) owns the points on the edge.
    static bool owns_edge(double ax, double ay, double bx, double by, double side) {
        const double rise = side * (by - ay), run = side * (bx - ax);
        return rise > 0 || (rise == 0 && run > 0);
    }

    std::array<double, 3> s_, t_, depth_;
    bool fronts_only_;
};

/// Sample of a region's depth buffer, 8 bytes. Weights and radiance are computed after all triangles are drawn.
struct NearestTriangle {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    float depth = std::numeric_limits<float>::infinity();
    std::uint32_t triangle = none;
};

/// Records triangle `index` as the visible one of the ray through (s, t) if the ray meets it at a depth of at least
/// `min_depth` and less than the recorded depth. Of two triangles at equal depth the first is kept.
inline void see(NearestTriangle& nearest, std::uint32_t index, const ObliqueTriangle& triangle, double s, double t,
                double min_depth = -std::numeric_limits<double>::infinity()) {
    if (nearest.triangle == index) return;
    const ObliqueTriangle::Hit hit = triangle.at(s, t);
    const float depth = static_cast<float>(hit.depth);
    if (hit && hit.depth >= min_depth && depth < nearest.depth) nearest = {depth, index};
}

/// Returns the point at which the ray through (s, t) meets a triangle: barycentric weights, and the depth ζ in metres,
/// infinite if the ray misses.
/// @param index     index of the triangle in its scene
/// @param triangle  the same triangle, projected along the direction of the ray
inline VisiblePoint visible_point(std::size_t index, const ObliqueTriangle& triangle, double s, double t) {
    const ObliqueTriangle::Hit hit = triangle.at(s, t);
    return {index, static_cast<float>(hit.weights[0]), static_cast<float>(hit.weights[1]),
            static_cast<float>(hit.weights[2]), hit.depth};
}

/// Shades the visible triangle of the ray of hogel (t, s) in direction (v, u), and stores the sample in the tile.
inline void store(LightFieldTile& tile, const ShadedScene& scene, const LightFieldGrid& grid,
                  const NearestTriangle& nearest, std::size_t t, std::size_t s, std::size_t v, std::size_t u) {
    VisiblePoint point;
    if (nearest.triangle != NearestTriangle::none) {
        const ObliqueTriangle triangle(scene, nearest.triangle, grid, static_cast<double>(u), static_cast<double>(v));
        point = visible_point(nearest.triangle, triangle, grid.s(static_cast<double>(tile.range.s0 + s)),
                              grid.t(static_cast<double>(tile.range.t0 + t)));
    }
    store(tile, scene, grid, point, t, s, v, u);
}

/// Returns the triangles with an area. A triangle thinner than 1e-12 of its length covers samples only by rounding.
/// @param list  an earlier list, for reusing its memory
inline std::vector<std::uint32_t> triangles_with_area(const ShadedScene& scene, std::vector<std::uint32_t> list = {}) {
    list.clear();
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const auto& [a, b, c] = scene.triangles[i].vertices;
        const Vec3 ab = scene.positions[b] - scene.positions[a], ac = scene.positions[c] - scene.positions[a];
        const Vec3 bc = ac - ab, normal = cross(ab, ac);
        const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
        if (dot(normal, normal) > 1e-24 * longest * longest) list.push_back(static_cast<std::uint32_t>(i));
    }
    return list;
}

}  // namespace hogel::render
