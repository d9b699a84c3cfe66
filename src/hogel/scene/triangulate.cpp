// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/triangulate.h"

#include <cmath>
#include <numeric>

namespace hogel::scene {
namespace {

struct Point {
    double x, y;
};

/// Twice the signed area: positive if the corners run counterclockwise.
double orientation(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Projects a polygon along the axis closest to its normal, counterclockwise.
std::vector<Point> flatten(std::span<const Vec3> polygon) {
    Vec3 normal;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        normal += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    std::vector<Point> points;
    points.reserve(polygon.size());
    for (const Vec3 p : polygon) {
        if (z >= x && z >= y)
            points.push_back(normal.z < 0 ? Point{p.y, p.x} : Point{p.x, p.y});
        else if (x >= y)
            points.push_back(normal.x < 0 ? Point{p.z, p.y} : Point{p.y, p.z});
        else
            points.push_back(normal.y < 0 ? Point{p.x, p.z} : Point{p.z, p.x});
    }
    return points;
}

bool is_ear(const std::vector<Point>& points, const std::vector<std::uint32_t>& ring, std::size_t i) {
    const std::size_t n = ring.size();
    const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
    const Point a = points[ring[before]], b = points[ring[i]], c = points[ring[after]];
    if (!(orientation(a, b, c) > 0)) return false;
    for (std::size_t k = 0; k < n; ++k) {
        if (k == before || k == i || k == after) continue;
        const Point p = points[ring[k]];
        const bool corner = (p.x == a.x && p.y == a.y) || (p.x == b.x && p.y == b.y) || (p.x == c.x && p.y == c.y);
        if (!corner && orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0)
            return false;
    }
    return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3> polygon) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    if (polygon.size() < 3) return triangles;
    const std::vector<Point> points = flatten(polygon);
    std::vector<std::uint32_t> ring(polygon.size());
    std::iota(ring.begin(), ring.end(), 0u);
    std::size_t i = 1;
    while (ring.size() > 3) {
        std::size_t tries = 0;
        while (tries < ring.size() && !is_ear(points, ring, i % ring.size())) ++i, ++tries;
        i %= ring.size();  // degenerate polygon without an ear: clip any corner
        const std::size_t n = ring.size();
        triangles.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    }
    triangles.push_back({ring[0], ring[1], ring[2]});
    return triangles;
}

}  // namespace hogel::scene
