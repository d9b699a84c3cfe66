// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "hogel/stereogram/frequency_grid.h"

namespace hogel::stereogram {

/// Number of hogels side by side in the arrays of average_lobes().
inline constexpr std::size_t hogels_at_once = 16;

/// out[i][hogel] = √(scale · weighted mean of rays[v u][hogel]) for lobe i of a frequency grid; if the rays are already
/// roots, √scale · mean. Plain and fast twins agree to rounding.
void average_lobes_plain(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                         std::size_t row_length, bool of_roots, float* out);
extern decltype(average_lobes_plain)& average_lobes;

/// to[column · to_row + row] = from[row · from_row + column] for the rows and columns of `from`. The plain and the fast
/// twin (four by four at once) give the same.
void transpose_plain(const float* from, std::size_t from_row, std::size_t rows, std::size_t columns, float* to,
                     std::size_t to_row);
extern decltype(transpose_plain)& transpose;

}  // namespace hogel::stereogram
