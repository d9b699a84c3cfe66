// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "hogel/array.h"
#include "hogel/light_field.h"

namespace hogel::stereogram {

/// Random phases in cycles, for one look and colour.
struct CycleSeries {
    std::array<std::uint32_t, 2> key;  ///< the seed
    std::uint32_t series;              ///< look and colour
    /// The phase of the surface point of a column and a row; or, with `direction` counted from one, of a ray of the
    /// hogel there that meets nothing.
    double operator()(std::uint32_t column, std::uint32_t row, std::uint32_t direction = 0) const;
};

/// The phases of surface points by column and row. Those around a range are precomputed, because many hogels see each
/// point.
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
