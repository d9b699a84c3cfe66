// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

namespace hogel::stereogram {

/// Range of `count` rows of a hogel's waves from row `first`, cyclic like the frequencies. Default: all rows.
struct InBandRows {
    std::size_t first = 0, count = std::numeric_limits<std::size_t>::max();

    /// @param rows  total number of rows
    bool has(std::size_t row, std::size_t rows) const {
        return (row >= first ? row - first : row + rows - first) < count;
    }
    /// Returns whether the range contains any of the `block_rows` rows that begin at `row`.
    bool has_any(std::size_t row, std::size_t block_rows, std::size_t rows) const {
        for (std::size_t end = std::min(row + block_rows, rows); row < end; ++row)
            if (has(row, rows)) return true;
        return false;
    }
};

}  // namespace hogel::stereogram
