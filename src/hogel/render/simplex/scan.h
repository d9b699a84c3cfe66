// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "hogel/render/simplex/volume.h"
#include "hogel/render/span.h"

namespace hogel::render::simplex {

/// The column s where row t crosses the edge between two projected points, which are on different sides of the row or
/// on it. Source: [K] 5.7.4, the equation below (5.7).
template <std::size_t Size>
double crossing(const std::array<double, Size>& a, const std::array<double, Size>& b, double t) {
    const double from_a = t * a[axis::q] - a[axis::t], from_b = t * b[axis::q] - b[axis::t];
    if (from_a == from_b) return a[axis::s] / a[axis::q];
    const double weight_a = std::clamp(from_b / (from_b - from_a), 0.0, 1.0), weight_b = 1 - weight_a;
    return (weight_a * a[axis::s] + weight_b * b[axis::s]) / (weight_a * a[axis::q] + weight_b * b[axis::q]);
}

/// The rows and columns of hogels that a slice of a projected volume at one U and one V covers.
///
/// [K] calls the edges of the slice curves in (s, t). They are straight: (s, t) = (S, T)/Q is a central projection of
/// (S, T, Q), in which the edges are straight. Only the spacing of points along them is not uniform.
class SliceInHogels {
  public:
    explicit SliceInHogels(const Simplex<2>& slice);

    Span rows(std::size_t nt) const;
    /// Source: [K] 5.7.4.
    Span columns(std::size_t row, std::size_t ns) const;

  private:
    const Simplex<2>& slice_;
    std::array<double, 3> s_, t_;
};

}  // namespace hogel::render::simplex
