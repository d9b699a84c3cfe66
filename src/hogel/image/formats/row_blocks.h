// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include "hogel/core/stop_scope.h"

namespace hogel::image {

/// Calls body(first, last) for blocks of rows [first, last) in order. A block has about a million samples, in multiples
/// of the rows per strip of a file if possible. Checks for a stop request before each block, because exceptions must
/// not pass through the picture libraries. Throws Error(cancelled).
template <class Body>
void for_row_blocks(std::size_t rows, std::size_t samples_in_row, const Body& body) {
    constexpr std::size_t samples_between_checks = 1 << 20, rows_in_file = 32;
    std::size_t step = std::max<std::size_t>(samples_between_checks / std::max<std::size_t>(samples_in_row, 1), 1);
    if (step > rows_in_file) step -= step % rows_in_file;
    for (std::size_t first = 0; first < rows; first += step) {
        core::throw_if_stopped();
        body(first, std::min(first + step, rows));
    }
}

}  // namespace hogel::image
