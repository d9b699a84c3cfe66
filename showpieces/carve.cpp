// SPDX-License-Identifier: Apache-2.0
#include "showpieces/carve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace hogel::showpieces {
namespace {

using Index = std::uint32_t;
using Edge = std::array<Index, 2>;
using Holes = std::span<const std::vector<Parameter>>;

Parameter lerp(Parameter p, Parameter q, double w) { return {p.a + w * (q.a - p.a), p.b + w * (q.b - p.b)}; }
double distance(Parameter p, Parameter q) { return std::hypot(p.a - q.a, p.b - q.b); }

double distance_to_segment(Parameter p, Parameter q, Parameter r) {
    const double da = r.a - q.a, db = r.b - q.b;
    const double w = ((p.a - q.a) * da + (p.b - q.b) * db) / (da * da + db * db);
    return distance(p, lerp(q, r, std::clamp(w, 0.0, 1.0)));
}

/// Returns the distance to the nearest outline: negative inside a hole.
double clearance(Parameter p, Holes holes) {
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (const auto& hole : holes)
        for (std::size_t i = 0; i < hole.size(); ++i) {
            const Parameter q = hole[i], r = hole[(i + 1) % hole.size()];
            nearest = std::min(nearest, distance_to_segment(p, q, r));
            if ((q.b > p.b) != (r.b > p.b) && p.a < q.a + (p.b - q.b) / (r.b - q.b) * (r.a - q.a)) inside = !inside;
        }
    return inside ? -nearest : nearest;
}

/// Cuts holes into a grid. The `side` of a point is its clearance, exactly 0 on an outline.
class Carver {
  public:
    Carver(std::span<const double> columns, std::span<const double> rows, Holes holes) : holes_(holes) {
        const auto n = static_cast<Index>(columns.size());
        add({0, rows.front()});
        for (std::size_t k = 1; k + 1 < rows.size(); ++k)
            for (double a : columns) add({a, rows[k]});
        const Index top = add({0, rows.back()});
        const auto at = [n](std::size_t k, Index i) { return 1 + static_cast<Index>(k - 1) * n + i % n; };
        for (Index i = 0; i < n; ++i) {
            whole_.push_back({0, at(1, i + 1), at(1, i)});
            for (std::size_t k = 1; k + 2 < rows.size(); ++k) {
                // Diagonals are mirrored at the middle column, so that cuts of a symmetric pattern are symmetric.
                const Index p = at(k, i), q = at(k, i + 1), r = at(k + 1, i + 1), s = at(k + 1, i);
                if (2 * i < n) {
                    whole_.push_back({p, q, r});
                    whole_.push_back({p, r, s});
                } else {
                    whole_.push_back({p, q, s});
                    whole_.push_back({q, r, s});
                }
            }
            whole_.push_back({at(rows.size() - 2, i), at(rows.size() - 2, i + 1), top});
        }
    }

    CarvedGrid carve() {
        snap_to_corners();
        snap_to_outlines();
        for (const auto& triangle : whole_) cut(triangle);
        find_rims();
        drop_unused_points();
        return std::move(grid_);
    }

  private:
    Index add(Parameter p) {
        grid_.points.push_back(p);
        side_.push_back(clearance(p, holes_));
        return static_cast<Index>(grid_.points.size() - 1);
    }
    void move(Index i, Parameter p) {
        grid_.points[i] = p;
        side_[i] = 0;
    }

    /// Moves the nearest grid point into each sharp corner of an outline.
    void snap_to_corners() {
        for (const auto& hole : holes_)
            for (std::size_t i = 0; i < hole.size(); ++i) {
                const Parameter p = hole[(i + hole.size() - 1) % hole.size()], q = hole[i],
                                r = hole[(i + 1) % hole.size()];
                const double cosine =
                    ((q.a - p.a) * (r.a - q.a) + (q.b - p.b) * (r.b - q.b)) / (distance(p, q) * distance(q, r));
                if (cosine > std::cos(std::numbers::pi / 6)) continue;
                const auto nearest =
                    std::min_element(grid_.points.begin(), grid_.points.end(),
                                     [&](Parameter x, Parameter y) { return distance(x, q) < distance(y, q); });
                const auto index = static_cast<Index>(nearest - grid_.points.begin());
                if (side_[index] != 0) move(index, q);
            }
    }

    /// Moves points close to an outline onto it, to avoid slivers.
    void snap_to_outlines() {
        constexpr double close = 0.3;
        for (const auto& triangle : whole_)
            for (std::size_t k = 0; k < 3; ++k) {
                Index i = triangle[k], j = triangle[(k + 1) % 3];
                if (side_[i] * side_[j] >= 0) continue;
                const double w = crossing(i, j);
                if (w < close)
                    move(i, lerp(grid_.points[i], grid_.points[j], w));
                else if (w > 1 - close)
                    move(j, lerp(grid_.points[i], grid_.points[j], w));
            }
    }

    /// Returns the crossing of an outline with the edge from i to j, by bisection: 0 at i, 1 at j.
    double crossing(Index i, Index j) const {
        double low = 0, high = 1;
        for (int step = 0; step < 40; ++step) {
            const double middle = 0.5 * (low + high);
            const double side = clearance(lerp(grid_.points[i], grid_.points[j], middle), holes_);
            (side * side_[i] > 0 ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    Index cut_point(Index i, Index j) {
        if (i > j) std::swap(i, j);
        const auto [known, is_new] = cuts_.emplace(Edge{i, j}, Index{0});
        if (is_new) {
            known->second = add(lerp(grid_.points[i], grid_.points[j], crossing(i, j)));
            side_[known->second] = 0;
        }
        return known->second;
    }

    void cut(const std::array<Index, 3>& triangle) {
        std::vector<Index> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index i = triangle[k], j = triangle[(k + 1) % 3];
            if (side_[i] >= 0) corners.push_back(i);
            if (side_[i] * side_[j] < 0) corners.push_back(cut_point(i, j));
        }
        if (corners.size() < 3) return;
        if (std::all_of(corners.begin(), corners.end(), [&](Index i) { return side_[i] == 0; })) {
            const Parameter p = grid_.points[corners[0]], q = grid_.points[corners[1]], r = grid_.points[corners[2]];
            if (clearance({(p.a + q.a + r.a) / 3, (p.b + q.b + r.b) / 3}, holes_) < 0) return;
        }
        for (std::size_t k = 2; k < corners.size(); ++k)
            grid_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }

    /// Finds the rims. The surface is closed except for the holes, so an edge of a single triangle belongs to a rim.
    void find_rims() {
        std::map<Edge, int> edges;
        for (const auto& t : grid_.triangles)
            for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
        for (const auto& [edge, count] : edges)
            if (!edges.contains({edge[1], edge[0]})) grid_.rims.push_back(edge);
    }

    void drop_unused_points() {
        std::vector<Index> number(grid_.points.size(), ~Index{0});
        std::vector<Parameter> used;
        const auto renumber = [&](Index& i) {
            if (number[i] == ~Index{0}) {
                number[i] = static_cast<Index>(used.size());
                used.push_back(grid_.points[i]);
            }
            i = number[i];
        };
        for (auto& t : grid_.triangles)
            for (Index& i : t) renumber(i);
        for (auto& edge : grid_.rims)
            for (Index& i : edge) renumber(i);
        grid_.points = std::move(used);
    }

    Holes holes_;
    CarvedGrid grid_;
    std::vector<double> side_;
    std::vector<std::array<Index, 3>> whole_;
    std::map<Edge, Index> cuts_;
};

}  // namespace

CarvedGrid carve(std::span<const double> columns, std::span<const double> rows, Holes holes) {
    return Carver(columns, rows, holes).carve();
}

}  // namespace hogel::showpieces
