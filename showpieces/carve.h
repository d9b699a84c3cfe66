// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hogel::showpieces {

struct Parameter {
    double a = 0, b = 0;
};

/// Grid over a parameter plane with polygonal holes, as triangles with edges along the outlines of the holes.
struct CarvedGrid {
    std::vector<Parameter> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counterclockwise with a to the right and b up
    std::vector<std::array<std::uint32_t, 2>> rims;       ///< edges along the holes, with triangles on their left
};

/// Cuts holes into a grid with periodic columns (an angle). The first and the last row are single points (poles).
/// @param columns  a of each column, increasing, within one period of 2π
/// @param rows     b of each row from pole to pole, increasing
/// @param holes    simple polygons that do not touch the poles, each other, or the seam between the last and the first
///                 column; corners of the outline of more than 30 degrees are kept, others are rounded to the size of a
///                 cell
CarvedGrid carve(std::span<const double> columns, std::span<const double> rows,
                 std::span<const std::vector<Parameter>> holes);

}  // namespace hogel::showpieces
