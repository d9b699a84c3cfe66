// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/geometry.h"

namespace hogel::stereogram {

/// Cell of a surface: one luminous point. All rays that meet the cell share its position and phase.
struct SurfaceCell {
    double x = 0, y = 0, depth = 0;  ///< centre, and the requested depth ζ, metres
    double cycles = 0;               ///< phase, [0, 1)
    /// Mean energy of a ray relative to an isolated ray. Rays of one hogel that share a cell add coherently. Along each
    /// axis, with cells of w > 1 ray distances, a fraction w − 1 of the cells has two rays, the others one; over both
    /// axes this gives ((3w − 2)/w)².
    double crowding = 1;
};

/// A diffuse surface as cells with random phases. Rays of different hogels never meet a surface in exactly the same
/// points; rounding to cells fixed in space makes the waves of several hogels from one cell add up to one spherical
/// wave. A cell at depth ζ is |ζ|·ΔU wide, the distance of neighbouring rays of a hogel there: each hogel has one ray
/// per cell. |ζ| is rounded to sixteen steps per factor e. A camera that resolves cells sees bright points with gaps;
/// cells are therefore shifted in each look, and the mean over looks is an even surface.
class SurfaceCells {
  public:
    /// Minimum |ζ|, metres; smaller depths count as this one.
    static constexpr double shallowest = 1e-6;

    /// @param step_u, step_v  ΔU and ΔV of the rays
    SurfaceCells(double step_u, double step_v, std::uint64_t seed, std::size_t channel);

    /// Returns the cell of the point (x, y) at depth ζ, which must be finite with |ζ| ≥ `shallowest`. Metres.
    SurfaceCell find(double x, double y, double depth, std::size_t look) const;

  private:
    double step_u_, step_v_;
    std::uint64_t seed_;
    std::size_t channel_;
};

}  // namespace hogel::stereogram
