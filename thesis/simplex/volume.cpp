// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/error.h"
#include "thesis/simplex/slice.h"

namespace hogel::simplex {
namespace {

// Returns the part of a convex polygon with side(point) >= 0. A point between two corners is always computed
// from the corner with the smaller value, so that both sides of a clip have the same points.
template <class Point, class Side, class Interpolate>
std::vector<Point> clip_polygon(const std::vector<Point>& polygon, const Side& side, const Interpolate& interpolate) {
    std::vector<Point> clipped;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &current = polygon[i], &next = polygon[(i + 1) % polygon.size()];
        const double a = side(current), b = side(next);
        if (a >= 0) clipped.push_back(current);
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
            clipped.push_back(a < b ? interpolate(current, next, a / (a - b))
                                    : interpolate(next, current, b / (b - a)));
        }
    }
    return clipped;
}

CameraPoint point_on_line(const CameraPoint& p, const CameraPoint& q, double f) {
    return {p.s + f * (q.s - p.s), p.t + f * (q.t - p.t)};
}

// Margin of a region around its outermost hogels, in hogels, so that a region of one hogel is not a point.
constexpr double margin = 1e-3;

// N·(P − (s, t, 0)): positive for camera points that see the front of a triangle, negative if they see its back.
class Facing {
  public:
    Facing(const DeepTriangle& triangle, const LightFieldGrid& grid, const HogelRange& range)
        : a_(triangle[0]), grid_(grid), range_(range) {
        const auto& [a, b, c] = triangle;
        const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
        const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
        normal_ = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
    }

    double operator()(const CameraPoint& p) const {
        const double s = grid_.s(static_cast<double>(range_.s0) + p.s);
        const double t = grid_.t(static_cast<double>(range_.t0) + p.t);
        return normal_[0] * (a_[0] - s) + normal_[1] * (a_[1] - t) + normal_[2] * a_[2];
    }

  private:
    std::array<double, 3> a_, normal_;
    const LightFieldGrid& grid_;
    const HogelRange& range_;
};

// Returns a point seen by a camera, before the division: right and up in the picture, the camera's (s, t), and forward.
ProjectedPoint as_seen(const std::array<double, 3>& point, CameraPoint camera, const LightFieldGrid& grid,
                       const HogelRange& range) {
    const double s = grid.s(static_cast<double>(range.s0) + camera.s);
    const double t = grid.t(static_cast<double>(range.t0) + camera.t);
    const auto [right, up, forward] = to_face(grid.face(), {point[0] - s, point[1] - t, point[2]});
    return {right, up, camera.s, camera.t, forward};
}

ProjectedPoint divided(const ProjectedPoint& seen, const LightFieldGrid& grid) {
    const auto [right, up, s, t, forward] = seen;
    return {grid.column(right / forward), grid.row(up / forward), s / forward, t / forward, 1 / forward};
}

// Clips simplices of undivided points at the distance `min_forward`, then divides them.
template <std::size_t N>
void append_divided(std::vector<std::array<ProjectedPoint, N>>& seen, double min_forward, const LightFieldGrid& grid,
                    std::vector<std::array<ProjectedPoint, N>>& simplices) {
    if (min_forward > 0) clip(seen, axis::q, min_forward, true);
    for (const std::array<ProjectedPoint, N>& simplex : seen) {
        std::array<ProjectedPoint, N>& appended = simplices.emplace_back();
        for (std::size_t i = 0; i < N; ++i) appended[i] = divided(simplex[i], grid);
    }
}

}  // namespace

DeepTriangle deep_triangle(const ShadedScene& scene, std::size_t index) {
    DeepTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = scene.positions[scene.triangles[index].vertices[i]];
        triangle[i] = {p.x, p.y, -p.z};
    }
    return triangle;
}

double near_plane(const ShadedScene& scene, std::string_view renderer) {
    double size = 0, nearest = std::numeric_limits<double>::infinity();
    for (const ShadedScene::Triangle& triangle : scene.triangles)
        for (std::uint32_t vertex : triangle.vertices) {
            const Vec3& p = scene.positions[vertex];
            size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            nearest = std::min(nearest, -p.z);
        }
    if (nearest <= 0)
        throw Error(ErrorCode::usage, "algorithm",
                    fmt::format("renderer '{}' needs the whole scene behind the hologram plane, but its nearest point "
                                "is at z = {:g} m; 'raytrace' has no such limit",
                                renderer, -nearest));
    return 1e-6 * size;
}

std::vector<DeepTriangle> clip_to_near_plane(const DeepTriangle& triangle, double near) {
    using Point = std::array<double, 3>;
    const auto interpolate = [near](const Point& a, const Point& b, double f) {
        return Point{a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), near};
    };
    const std::vector<Point> clipped = clip_polygon<Point>(
        {triangle[0], triangle[1], triangle[2]}, [near](const Point& p) { return p[2] - near; }, interpolate);
    std::vector<DeepTriangle> triangles;
    for (std::size_t i = 2; i < clipped.size(); ++i) triangles.push_back({clipped[0], clipped[i - 1], clipped[i]});
    return triangles;
}

double min_forward_distance(const LightFieldGrid& grid, double near) {
    double max_depth = 0;  // largest depth of a ray one unit forward
    for (const double u : {-1.0, 1.0})
        for (const double v : {-1.0, 1.0})
            max_depth =
                std::max(max_depth,
                         grid.direction_of(grid.center_u() + u * grid.half_u(), grid.center_v() + v * grid.half_v()).z);
    return near / max_depth;
}

std::array<ProjectedPoint, 3> project(const DeepTriangle& triangle, CameraPoint camera, const LightFieldGrid& grid,
                                      const HogelRange& range) {
    std::array<ProjectedPoint, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = divided(as_seen(triangle[i], camera, grid, range), grid);
    return points;
}

RegionSides split_at_back_face(const DeepTriangle& triangle, const LightFieldGrid& grid, const HogelRange& range) {
    const Facing front(triangle, grid, range);
    const auto back = [&](const CameraPoint& p) { return -front(p); };
    const double right = static_cast<double>(range.ns) - 1 + margin;
    const double bottom = static_cast<double>(range.nt) - 1 + margin;
    const std::vector<CameraPoint> rectangle{{-margin, -margin}, {right, -margin}, {right, bottom}, {-margin, bottom}};
    return {clip_polygon(rectangle, front, point_on_line), clip_polygon(rectangle, back, point_on_line)};
}

std::vector<CameraLine> split_row_at_back_face(const DeepTriangle& triangle, std::size_t row,
                                               const LightFieldGrid& grid, const HogelRange& range) {
    const Facing facing(triangle, grid, range);
    const CameraPoint first{-margin, static_cast<double>(row)};
    const CameraPoint last{static_cast<double>(range.ns) - 1 + margin, first.t};
    const double a = facing(first), b = facing(last);
    if (!(a < 0 && b > 0) && !(a > 0 && b < 0)) return {{first, last, a > 0 || b > 0}};
    const CameraPoint between = point_on_line(first, last, a / (a - b));
    return {{first, between, a > 0}, {between, last, b > 0}};
}

void append_projected_volume(const DeepTriangle& triangle, const std::vector<CameraPoint>& region,
                             const LightFieldGrid& grid, const HogelRange& range, std::vector<Simplex<4>>& simplices,
                             double min_forward) {
    std::vector<Simplex<4>> undivided;
    for (std::size_t i = 2; i < region.size(); ++i) {
        const std::array corners{region[0], region[i - 1], region[i]};
        for (const auto& path : product_paths<5>(2)) {
            Simplex<4>& simplex = undivided.emplace_back();
            for (std::size_t k = 0; k < 5; ++k)
                simplex[k] = as_seen(triangle[path[k].second], corners[path[k].first], grid, range);
        }
    }
    append_divided(undivided, min_forward, grid, simplices);
}

void append_projected_volume(const DeepTriangle& triangle, const CameraLine& line, const LightFieldGrid& grid,
                             const HogelRange& range, std::vector<Simplex<3>>& simplices, double min_forward) {
    const std::array ends{line.first, line.last};
    std::vector<Simplex<3>> undivided;
    for (const auto& path : product_paths<4>(1)) {
        Simplex<3>& simplex = undivided.emplace_back();
        for (std::size_t k = 0; k < 4; ++k)
            simplex[k] = as_seen(triangle[path[k].second], ends[path[k].first], grid, range);
    }
    append_divided(undivided, min_forward, grid, simplices);
}

}  // namespace hogel::simplex
