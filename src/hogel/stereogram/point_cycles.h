// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "hogel/array.h"
#include "hogel/light_field.h"

namespace hogel::stereogram {

/// Random phases in cycles [0, 1), for one look and channel.
struct CycleSeries {
    std::array<std::uint32_t, 2> key;  ///< the seed
    std::uint32_t series;              ///< look and channel
    /// Returns the phase of the surface point in this column and row. With direction ≥ 1: the phase of a ray that meets
    /// no surface, in that direction from the hogel in this column and row.
    double operator()(std::uint32_t column, std::uint32_t row, std::uint32_t direction = 0) const;
};

/// Phases of surface points by column and row, in cycles. Phases of points in a range are precomputed, because many
/// hogels share a point.
class PointCycles {
  public:
    PointCycles(const CycleSeries& series, const HogelRange& points);

    double operator()(std::int64_t column, std::int64_t row) const {
        const auto x = static_cast<std::size_t>(column - column0_), y = static_cast<std::size_t>(row - row0_);
        return x < cycles_.extent(1) && y < cycles_.extent(0) ? cycles_(y, x) : draw(column, row);
    }

  private:
    double draw(std::int64_t column, std::int64_t row) const {
        return series_(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    }

    CycleSeries series_;
    std::int64_t column0_, row0_;
    Array<double, 2> cycles_;
};

}  // namespace hogel::stereogram
