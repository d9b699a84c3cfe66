// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/geometry.h"

namespace hogel::hologram {

/// A cell of a surface, which acts as one luminous point at its centre: all rays that meet the cell share that position
/// and phase.
struct SurfaceCell {
    double x = 0, y = 0, depth = 0;  ///< its centre, metres; depth ζ
    double cycles = 0;               ///< its phase, [0, 1)
};

/// A diffuse surface as cells, each with a random phase. Rays of different hogels never meet a surface in exactly the
/// same points; their points are rounded to cells fixed in space, so that the waves of several hogels from one cell add
/// up to one spherical wave. A cell at depth ζ is |ζ|·ΔU wide, the distance of neighbouring rays of a hogel there, so
/// that each hogel has one ray for it. Depths are rounded to steps of 1/64, which is less than the depth of focus of
/// such a cell.
class SurfaceCells {
  public:
    /// The minimum |ζ|, metres; smaller depths count as this one.
    static constexpr double shallowest = 1e-6;

    /// @param step_u, step_v  ΔU and ΔV of the rays
    SurfaceCells(double step_u, double step_v, std::uint64_t seed, std::size_t channel);

    /// The cell of the point (x, y) at depth ζ, which must be finite with |ζ| >= `shallowest`.
    SurfaceCell find(double x, double y, double depth, std::size_t look) const;

  private:
    double step_u_, step_v_;
    std::uint64_t seed_;
    std::size_t channel_;
};

}  // namespace hogel::hologram
