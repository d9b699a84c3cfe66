// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "hogel/hologram/frequency_grid.h"

namespace hogel::hologram {

/// How many hogels lie side by side in the arrays of average_lobes().
inline constexpr std::size_t hogels_at_once = 16;

/// out[i][hogel] = √(scale · weighted mean of rays[v u][hogel]) for lobe i of a frequency grid, or where the rays are
/// roots already √scale · mean; plain, and as fast as this processor allows. The twins agree to rounding.
void average_lobes_plain(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                         std::size_t row_length, bool of_roots, float* out);
void average_lobes(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                   std::size_t row_length, bool of_roots, float* out);

/// to[column · to_row + row] = from[row · from_row + column] for the rows and columns of `from`; plain, and four of
/// each at once. The twins give the same.
void transpose_plain(const float* from, std::size_t from_row, std::size_t rows, std::size_t columns, float* to,
                     std::size_t to_row);
void transpose(const float* from, std::size_t from_row, std::size_t rows, std::size_t columns, float* to,
               std::size_t to_row);

}  // namespace hogel::hologram
