// SPDX-License-Identifier: Apache-2.0
#include "bench/render/rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/work/parallel.h"

namespace hogel::bench {

HogelRows::HogelRows(const LightFieldSource& source, std::size_t rows) : source_(source) {
    const LightFieldGrid& grid = source.grid();
    rows = std::min(rows, grid.hogels_t);
    const std::size_t width = std::min(source.preferred_tile().ns, grid.hogels_s);
    for (std::size_t i = 0; i < rows; ++i) {
        rows_.push_back((2 * i + 1) * grid.hogels_t / (2 * rows));
        for (std::size_t s = 0; s < grid.hogels_s; s += width)
            tiles_.emplace_back(grid, HogelRange{s, rows_[i], std::min(width, grid.hogels_s - s), 1}, false);
    }
}

void HogelRows::render() {
    work::parallel_for(tiles_.size(), [&](std::size_t i) { source_.read(tiles_[i]); });
}

std::vector<HogelIndex> HogelRows::subset(std::size_t count) const {
    const std::size_t width = source_.grid().hogels_s;
    std::vector<HogelIndex> hogels;
    for (std::size_t i = 0; i < count; ++i) {
        // Columns advance by the golden ratio, so that no row repeats the columns of another.
        const double position = (static_cast<double>(i) + 0.5) * std::numbers::phi;
        const auto column = static_cast<std::size_t>((position - std::floor(position)) * static_cast<double>(width));
        hogels.push_back({column, rows_[(2 * i + 1) * rows_.size() / (2 * count)]});
    }
    return hogels;
}

Rgb HogelRows::sample(HogelIndex hogel, std::size_t v, std::size_t u) const {
    const LightFieldTile& tile = *std::ranges::find_if(tiles_, [&](const LightFieldTile& candidate) {
        return candidate.range.t0 == hogel.t && candidate.range.s0 <= hogel.s &&
               hogel.s < candidate.range.s0 + candidate.range.ns;
    });
    const std::size_t s = hogel.s - tile.range.s0;
    return {tile.radiance(0, 0, s, v, u), tile.radiance(1, 0, s, v, u), tile.radiance(2, 0, s, v, u)};
}

}  // namespace hogel::bench
