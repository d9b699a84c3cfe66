// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/array.h"

namespace hogel::render {

/// Adds the samples of each cell of n × n to its sum in double precision: sums(v, u) += Σ samples(n v + a, n u + b) for
/// a, b = 0 … n − 1, one by one, a in the outer loop. Both versions give the same bits on every SIMD target.
void add_cells_plain(View<const float, 2> samples, std::size_t n, View<double, 2> sums);
extern decltype(add_cells_plain)& add_cells;

}  // namespace hogel::render
