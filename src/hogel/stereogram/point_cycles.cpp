// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/point_cycles.h"
#include "hogel/core/random.h"

namespace hogel::stereogram {
namespace {

constexpr std::int64_t margin = 32;  // points beyond the range on each side

}  // namespace

double CycleSeries::operator()(std::uint32_t column, std::uint32_t row, std::uint32_t direction) const {
    return core::philox({column, row, direction, series}, key)[0] / 4294967296.0;
}

PointCycles::PointCycles(const CycleSeries& series, const HogelRange& points)
    : series_(series),
      column0_(static_cast<std::int64_t>(points.s0) - margin),
      row0_(static_cast<std::int64_t>(points.t0) - margin),
      cycles_({points.nt + 2 * margin, points.ns + 2 * margin}) {
    for (std::size_t row = 0; row < cycles_.extent(0); ++row)
        for (std::size_t column = 0; column < cycles_.extent(1); ++column)
            cycles_(row, column) =
                draw(column0_ + static_cast<std::int64_t>(column), row0_ + static_cast<std::int64_t>(row));
}

}  // namespace hogel::stereogram
