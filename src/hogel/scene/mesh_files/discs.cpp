// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "hogel/error.h"
#include "hogel/scene.h"
#include "hogel/scene/mesh_files/points.h"
#include "hogel/work/parallel.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::size_t neighbours = 8;  // of a fitted plane
constexpr std::size_t radius_of = 6;   // index of the neighbour at the distance of a disc's radius
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t points_per_task = 1024;

using Nearest = std::array<std::uint32_t, neighbours>;

/// k-d tree of points: each node is a range of a list, split at the median of its longest side (Bentley, 1975).
class PointTree {
  public:
    explicit PointTree(const std::vector<Vec3>& points) : points_(points), order_(points.size()) {
        for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
        axes_.resize(order_.size());
        build(0, order_.size());
    }

    /// Returns the nearest other points, by distance, then index; padded with `none`.
    Nearest nearest(std::uint32_t point) const {
        Found found;
        search(0, order_.size(), point, found);
        Nearest result;
        for (std::size_t i = 0; i < neighbours; ++i) result[i] = i < found.count ? found.best[i].second : none;
        return result;
    }

  private:
    struct Found {
        std::array<std::pair<double, std::uint32_t>, neighbours> best;  // squared distance and point, sorted
        std::size_t count = 0;

        bool is_too_far(double squared) const { return count == neighbours && squared > best.back().first; }
        void add(const std::pair<double, std::uint32_t>& candidate) {
            if (count == neighbours && !(candidate < best.back())) return;
            if (count < neighbours) ++count;
            std::size_t i = count - 1;
            for (; i > 0 && candidate < best[i - 1]; --i) best[i] = best[i - 1];
            best[i] = candidate;
        }
    };

    static double along(Vec3 p, std::uint8_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

    void build(std::size_t begin, std::size_t end) {
        if (end - begin < 2) return;
        Vec3 low = points_[order_[begin]], high = low;
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3 p = points_[order_[i]];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        const Vec3 size = high - low;
        const std::uint8_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto iterator = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(iterator(begin), iterator(middle), iterator(end), [&](std::uint32_t a, std::uint32_t b) {
            const double pa = along(points_[a], axis), pb = along(points_[b], axis);
            return pa != pb ? pa < pb : a < b;
        });
        axes_[middle] = axis;
        build(begin, middle);
        build(middle + 1, end);
    }

    void search(std::size_t begin, std::size_t end, std::uint32_t point, Found& found) const {
        if (begin >= end) return;
        const std::size_t middle = begin + (end - begin) / 2;
        const std::uint32_t other = order_[middle];
        const Vec3 d = points_[other] - points_[point];
        if (other != point) found.add({dot(d, d), other});
        const double beyond = -along(d, axes_[middle]);  // distance of the point beyond the splitting plane
        const bool first_high = beyond > 0;
        if (first_high)
            search(middle + 1, end, point, found);
        else
            search(begin, middle, point, found);
        if (found.is_too_far(beyond * beyond)) return;
        if (first_high)
            search(begin, middle, point, found);
        else
            search(middle + 1, end, point, found);
    }

    const std::vector<Vec3>& points_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint8_t> axes_;  // axis of the split at the middle of each node
};

/// Returns the direction of least variance, an eigenvector of the covariance, by Jacobi rotations.
Vec3 thinnest_direction(const std::vector<Vec3>& points) {
    Vec3 mean{0, 0, 0};
    for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
    std::array<std::array<double, 3>, 3> a{}, v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (const Vec3& p : points) {
        const std::array<double, 3> d{p.x - mean.x, p.y - mean.y, p.z - mean.z};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) a[i][k] += d[i] * d[k];
    }
    for (int sweep = 0; sweep < 12; ++sweep)
        for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
            if (a[p][q] == 0) continue;
            const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
            const double c = 1 / std::sqrt(t * t + 1), s = t * c;
            for (std::size_t k = 0; k < 3; ++k) {
                const double kp = a[k][p], kq = a[k][q];
                a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const double pk = a[p][k], qk = a[q][k];
                a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
                const double vp = v[k][p], vq = v[k][q];
                v[k][p] = c * vp - s * vq, v[k][q] = s * vp + c * vq;
            }
        }
    const std::array<double, 3> values{a[0][0], a[1][1], a[2][2]};
    const auto least = static_cast<std::size_t>(std::ranges::min_element(values) - values.begin());
    return {v[0][least], v[1][least], v[2][least]};
}

/// Orients normals consistently: starts at the point of each connected part farthest from the centroid, with an outward
/// normal, and follows the tree of least normal difference.
void orient(const std::vector<Vec3>& points, const std::vector<Nearest>& nearest, std::vector<Vec3>& normals) {
    Vec3 middle{0, 0, 0};
    for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
    std::vector<std::vector<std::uint32_t>> around(points.size());  // symmetric
    for (std::uint32_t i = 0; i < points.size(); ++i)
        for (const std::uint32_t other : nearest[i])
            if (other != none) {
                around[i].push_back(other);
                around[other].push_back(i);
            }
    std::vector<std::uint32_t> order(points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto distance = [&](std::uint32_t i) { return dot(points[i] - middle, points[i] - middle); };
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return distance(a) != distance(b) ? distance(a) > distance(b) : a < b;
    });
    struct Edge {
        double difference;
        std::uint32_t to, from;
        bool operator<(const Edge& other) const {  // least difference first
            return difference != other.difference ? difference > other.difference : to > other.to;
        }
    };
    std::vector<bool> done(points.size());
    for (const std::uint32_t first : order) {
        if (done[first]) continue;
        if (dot(normals[first], points[first] - middle) < 0) normals[first] = -normals[first];
        std::priority_queue<Edge> edges;
        edges.push({0, first, first});
        while (!edges.empty()) {
            const Edge edge = edges.top();
            edges.pop();
            if (done[edge.to]) continue;
            done[edge.to] = true;
            if (dot(normals[edge.to], normals[edge.from]) < 0) normals[edge.to] = -normals[edge.to];
            for (const std::uint32_t next : around[edge.to])
                if (!done[next]) edges.push({1 - std::abs(dot(normals[edge.to], normals[next])), next, edge.to});
        }
    }
}

/// Adds a hexagon perpendicular to the normal.
void add_disc(Vec3 middle, Vec3 normal, double radius, Mesh& mesh) {
    const Vec3 other = std::abs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = normalize(cross(normal, other)), up = cross(normal, across);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 6; ++i) {
        const double angle = i * std::numbers::pi / 3;
        mesh.positions.push_back(middle + radius * (std::cos(angle) * across + std::sin(angle) * up));
        mesh.normals.push_back(normal);
    }
    for (std::uint32_t i = 1; i < 5; ++i) mesh.triangles.push_back({first, first + i, first + i + 1});
}

}  // namespace

Mesh discs(const Points& points, double size) {
    if (!(size > 0 && std::isfinite(size)))
        throw Error(ErrorCode::usage, "point_size", fmt::format("points of size {}; expected a size above zero", size));
    const std::size_t count = points.positions.size();
    for (std::size_t i = 0; i < count; ++i)
        if (const Vec3 p = points.positions[i]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw Error(ErrorCode::bad_input, fmt::format("point {} not finite; expected numbers", i));
    const PointTree tree(points.positions);
    std::vector<Nearest> nearest(count);
    std::vector<Vec3> normals = points.normals;
    const bool find_normals = normals.empty();
    if (find_normals) normals.resize(count);
    work::parallel_for((count + points_per_task - 1) / points_per_task, [&](std::size_t task) {
        std::vector<Vec3> around;
        for (std::size_t i = task * points_per_task; i < std::min(count, (task + 1) * points_per_task); ++i) {
            nearest[i] = tree.nearest(static_cast<std::uint32_t>(i));
            if (!find_normals) continue;
            around.assign(1, points.positions[i]);
            for (const std::uint32_t other : nearest[i])
                if (other != none) around.push_back(points.positions[other]);
            normals[i] = thinnest_direction(around);
        }
    });
    if (find_normals) orient(points.positions, nearest, normals);
    Mesh mesh;
    mesh.name = points_name;
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t last = radius_of;  // the farthest, if there are fewer points
        while (last > 1 && nearest[i][last - 1] == none) --last;
        const std::uint32_t far = nearest[i][last - 1];
        const double radius = far == none ? 0 : length(points.positions[far] - points.positions[i]);
        if (!(radius > 0)) continue;
        add_disc(points.positions[i], normals[i], size * radius, mesh);
        if (!points.colors.empty()) mesh.colors.insert(mesh.colors.end(), 6, points.colors[i]);
    }
    if (!mesh.colors.empty()) mesh.material.base_color = {1, 1, 1};
    return mesh;
}

}  // namespace hogel::scene::mesh_files
