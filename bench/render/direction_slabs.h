// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hogel/light_field.h"

namespace hogel::bench {

/// Rows of directions V of all hogels.
struct DirectionSlab {
    std::size_t first = 0, rows = 0;

    /// Returns the grid with these directions only.
    LightFieldGrid of(const LightFieldGrid& grid) const {
        LightFieldGrid slab = grid;
        slab.directions_v = rows;
        slab.range().half_v = 0.5 * static_cast<double>(rows) * grid.step_v();
        slab.range().center_v = grid.v(static_cast<double>(first) + 0.5 * static_cast<double>(rows) - 0.5);
        return slab;
    }
};

/// Returns slabs of at most `max_rows` rows with `part` of all rows in total. For part = 1 they are consecutive and
/// cover all rows. Otherwise they are at least four slabs, spread evenly, down to one row each.
inline std::vector<DirectionSlab> direction_slabs(std::size_t directions_v, std::size_t max_rows, double part) {
    std::vector<DirectionSlab> slabs;
    if (part >= 1) {
        for (std::size_t first = 0; first < directions_v; first += max_rows)
            slabs.push_back({first, std::min(max_rows, directions_v - first)});
        return slabs;
    }
    const double target_rows =
        std::clamp(part * static_cast<double>(directions_v), 1.0, static_cast<double>(directions_v));
    const auto rows = std::clamp<std::size_t>(static_cast<std::size_t>(target_rows / 4), 1, max_rows);
    const auto count =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(target_rows / static_cast<double>(rows))),
                                std::min<std::size_t>(4, directions_v), directions_v / rows);
    const double spacing = static_cast<double>(directions_v) / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i)
        slabs.push_back(
            {static_cast<std::size_t>((static_cast<double>(i) + 0.5) * spacing - 0.5 * static_cast<double>(rows)),
             rows});
    return slabs;
}

}  // namespace hogel::bench
