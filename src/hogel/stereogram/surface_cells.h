// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/geometry.h"

namespace hogel::stereogram {

/// A cell of a surface, which acts as one luminous point at its centre: all rays that meet the cell share that position
/// and phase.
struct SurfaceCell {
    double x = 0, y = 0, depth = 0;  ///< its centre across and up, and the depth ζ that was asked for, metres
    double cycles = 0;               ///< its phase, [0, 1)
    /// The mean energy of a ray, over that of a ray alone, that comes from rays of one hogel sharing cells: they add in
    /// step. A cell w times as wide as the distance of rays has one ray, and w − 1 of the cells have two, along each
    /// axis; on both axes together w > 1 gives ((3w − 2)/w)².
    double crowding = 1;
};

/// A diffuse surface as cells, each with a random phase. Rays of different hogels never meet a surface in exactly the
/// same points; their points are rounded to cells fixed in space, so that the waves of several hogels from one cell add
/// up to one spherical wave. A cell at depth ζ is |ζ|·ΔU wide, the distance of neighbouring rays of a hogel there, so
/// that each hogel has one ray for it; for this |ζ| is rounded to steps of 1/16. Where a camera resolves cells, they
/// are bright points with darkness between them; so the cells lie elsewhere in each look, and the mean over looks is an
/// even surface.
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

}  // namespace hogel::stereogram
