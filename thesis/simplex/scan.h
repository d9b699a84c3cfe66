// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "hogel/render/span.h"
#include "thesis/simplex/volume.h"

namespace hogel::simplex {

/// Returns the column s at which row t crosses the edge between two projected points. The points are on different sides
/// of the row or on it. Source: [K] 5.7.4, the equation below (5.7).
template <std::size_t Size>
double crossing(const std::array<double, Size>& a, const std::array<double, Size>& b, double t) {
    const double from_a = t * a[axis::q] - a[axis::t], from_b = t * b[axis::q] - b[axis::t];
    if (from_a == from_b) return a[axis::s] / a[axis::q];
    const double weight_a = std::clamp(from_b / (from_b - from_a), 0.0, 1.0), weight_b = 1 - weight_a;
    return (weight_a * a[axis::s] + weight_b * b[axis::s]) / (weight_a * a[axis::q] + weight_b * b[axis::q]);
}

struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    /// Includes the columns in which row t meets the triangle of three projected points with columns and rows (s, t).
    template <class Points, class Places>
    void include_row(const std::array<std::size_t, 3>& corners, const Points& points, const Places& st, double t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t a = corners[i], b = corners[i == 2 ? 0 : i + 1];
            const double ta = st[a][1], tb = st[b][1];
            // A row within the margin of a corner may not cross either edge there, so the corner is included.
            if (std::abs(ta - t) <= render::scan_margin) include(st[a][0]);
            if ((ta <= t && t <= tb) || (tb <= t && t <= ta)) include(crossing(points[a], points[b], t));
        }
    }
    /// Returns the range of the samples 0 to n − 1 between low and high.
    render::Span samples(std::size_t n) const { return render::samples_between(low, high, n); }
};

/// Returns the column and row of hogels (s, t) of a projected point.
inline std::array<double, 2> place_in_hogels(const ProjectedPoint& point) {
    const double depth = 1 / point[axis::q];
    return {point[axis::s] * depth, point[axis::t] * depth};
}

/// Rows and columns of hogels covered by a slice of a projected volume at one U and one V.
///
/// [K] calls the edges of the slice curves in (s, t). They are straight: (s, t) = (S, T)/Q is a central projection of
/// (S, T, Q), in which the edges are straight. Only the spacing of points along them is not uniform.
class SliceInHogels {
  public:
    explicit SliceInHogels(const Simplex<2>& slice);

    render::Span rows(std::size_t nt) const;
    /// Source: [K] 5.7.4.
    render::Span columns(std::size_t row, std::size_t ns) const;

  private:
    const Simplex<2>& slice_;
    std::array<std::array<double, 2>, 3> st_;
};

}  // namespace hogel::simplex
