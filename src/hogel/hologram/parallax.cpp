// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/parallax.h"

#include <algorithm>
#include <cmath>

namespace hogel::hologram {

double neighbouring_parallax(const LightFieldSource& light_field, double pitch) {
    if (!light_field.has_depth()) return 0;
    const LightFieldGrid& grid = light_field.grid();
    constexpr std::size_t places = 5;
    double max_depth = 0;
    for (std::size_t j = 0; j < places; ++j)
        for (std::size_t i = 0; i < places; ++i) {
            LightFieldTile tile(
                grid, {(2 * i + 1) * grid.hogels_s / (2 * places), (2 * j + 1) * grid.hogels_t / (2 * places), 1, 1},
                true);
            light_field.read(tile);
            for (const float depth : tile.depth.elements())
                if (std::isfinite(depth)) max_depth = std::max(max_depth, std::abs(static_cast<double>(depth)));
        }
    return max_depth * std::max(grid.step_u(), grid.step_v()) / pitch;
}

}  // namespace hogel::hologram
