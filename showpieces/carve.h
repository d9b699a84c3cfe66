// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hogel::showpieces {

/// A point of a surface's parameter plane.
struct Parameter {
    double a = 0, b = 0;
};

/// A grid over a parameter plane with polygonal holes cut out, as triangles whose edges follow the holes' outlines.
struct CarvedGrid {
    std::vector<Parameter> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counterclockwise with a to the right and b up
    std::vector<std::array<std::uint32_t, 2>> rims;       ///< edges along the holes, with triangles on their left
};

/// Cuts holes into a grid whose columns are periodic (an angle) and whose first and last row are single points (poles).
/// @param columns  a of each column, increasing, within one period of 2π
/// @param rows     b of each row from pole to pole, increasing
/// @param holes    simple polygons that do not touch the poles, each other, or the seam between the last and the first
///                 column; corners where the outline bends by more than 30 degrees are kept, others are rounded to the
///                 size of a cell
CarvedGrid carve(std::span<const double> columns, std::span<const double> rows,
                 std::span<const std::vector<Parameter>> holes);

}  // namespace hogel::showpieces
