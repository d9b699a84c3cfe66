// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/geometry.h"

namespace hogel::hologram {

/// A point of a surface that shines as one: all rays that meet its neighbourhood share its place and its phase.
struct SurfacePoint {
    double x = 0, y = 0, depth = 0;  ///< metres; depth ζ
    double turns = 0;                ///< its phase, in turns, [0, 1)
};

/// A diffuse surface made of points in phase with themselves and out of phase with each other. Rays of different hogels
/// never meet a surface in quite the same points; this rounds what they meet to cells fixed in space, so that what
/// several hogels show of one cell adds up to one spherical wave. A cell at depth ζ is |ζ|·ΔU wide, as far apart as
/// neighbouring rays of a hogel are there, so that each hogel has one ray for it. Depths are rounded to steps of 1/64:
/// less than the depth of focus of a cell so wide.
class SurfaceCells {
  public:
    /// Depths nearer to the hologram's plane, in metres, are not told apart.
    static constexpr double shallowest = 1e-6;

    /// @param step_u, step_v  ΔU and ΔV of the rays
    SurfaceCells(double step_u, double step_v, std::uint64_t seed, std::size_t channel);

    /// The cell of the point (x, y) at depth ζ, which is finite and not nearer than `shallowest`.
    SurfacePoint find(double x, double y, double depth, std::size_t look) const;

  private:
    double step_u_, step_v_;
    std::uint64_t seed_;
    std::size_t channel_;
};

}  // namespace hogel::hologram
