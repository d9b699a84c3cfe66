// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "hogel/render/simplex/volume.h"
#include "hogel/render/span.h"

namespace hogel::render::simplex {

/// The column s where row t crosses the edge between two projected points, which are on different sides of the row or
/// on it. Source: [K] 5.7.4, the equation below (5.7).
double crossing(const ProjectedPoint& a, const ProjectedPoint& b, double t);

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
