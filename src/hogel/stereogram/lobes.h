// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "hogel/stereogram/frequency_grid.h"

namespace hogel::stereogram {

inline constexpr std::size_t hogels_at_once = 16;  ///< side by side in the arrays of average_lobes()

/// Computes out[i][hogel] = √(scale · weighted mean of rays[v u][hogel]) for lobe i of a frequency grid; if `of_roots`,
/// √scale · mean. Plain and fast versions agree to rounding.
void average_lobes_plain(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                         std::size_t row_length, bool of_roots, float* out);
extern decltype(average_lobes_plain)& average_lobes;

/// Computes to[column · to_stride + row] = from[row · from_stride + column]. Plain and fast versions give the same.
void transpose_plain(const float* from, std::size_t from_stride, std::size_t rows, std::size_t columns, float* to,
                     std::size_t to_stride);
extern decltype(transpose_plain)& transpose;

}  // namespace hogel::stereogram
