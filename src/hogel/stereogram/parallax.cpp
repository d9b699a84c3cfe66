// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/parallax.h"

#include <algorithm>
#include <cmath>

namespace hogel::stereogram {

namespace {

// Calls use(tile) for 25 hogels spread over the light field, one at a time.
template <class Use>
void for_some_hogels(const LightFieldSource& light_field, const Use& use) {
    const LightFieldGrid& grid = light_field.grid();
    constexpr std::size_t hogels_per_axis = 5;
    for (std::size_t j = 0; j < hogels_per_axis; ++j)
        for (std::size_t i = 0; i < hogels_per_axis; ++i) {
            LightFieldTile tile(grid,
                                {(2 * i + 1) * grid.hogels_s / (2 * hogels_per_axis),
                                 (2 * j + 1) * grid.hogels_t / (2 * hogels_per_axis), 1, 1},
                                true);
            light_field.read(tile);
            use(tile);
        }
}

}  // namespace

double neighbouring_parallax(const LightFieldSource& light_field, double pitch) {
    if (!light_field.has_depth()) return 0;
    double max_depth = 0;
    for_some_hogels(light_field, [&](const LightFieldTile& tile) {
        for (const float depth : tile.depth.elements())
            if (std::isfinite(depth)) max_depth = std::max(max_depth, std::abs(static_cast<double>(depth)));
    });
    const LightFieldGrid& grid = light_field.grid();
    return max_depth * std::max(grid.step_u(), grid.step_v()) / pitch;
}

bool has_picture_at_infinity(const LightFieldSource& light_field) {
    if (!light_field.has_depth()) return false;
    bool differ = false;
    for_some_hogels(light_field, [&](const LightFieldTile& tile) {
        const std::size_t rays = tile.depth.size();
        for (std::size_t channel = 0; channel < light_field.grid().channels; ++channel) {
            float low = HUGE_VALF, high = 0;
            for (std::size_t ray = 0; ray < rays; ++ray)
                if (!std::isfinite(tile.depth.data()[ray])) {
                    const float radiance = tile.radiance.data()[channel * rays + ray];
                    low = std::min(low, radiance), high = std::max(high, radiance);
                }
            differ = differ || high > 1.1f * low;
        }
    });
    return differ;
}

}  // namespace hogel::stereogram
