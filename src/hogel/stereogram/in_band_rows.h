// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

namespace hogel::stereogram {

/// Rows of a hogel's waves, first, first + 1, …, which follow each other in a circle, as frequencies do; by default all
/// of them.
struct InBandRows {
    std::size_t first = 0, count = std::numeric_limits<std::size_t>::max();

    /// @param rows  of all waves
    bool has(std::size_t row, std::size_t rows) const {
        return (row >= first ? row - first : row + rows - first) < count;
    }
    /// Whether one of `some` rows from `row` on is among them.
    bool has_any(std::size_t row, std::size_t some, std::size_t rows) const {
        for (std::size_t end = std::min(row + some, rows); row < end; ++row)
            if (has(row, rows)) return true;
        return false;
    }
};

}  // namespace hogel::stereogram
