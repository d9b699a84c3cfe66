// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "hogel/light_field.h"

namespace hogel::render {

/// Returns a tile about as large as default_tile(), but as long as possible along s or along t. For renderers that
/// process each row of hogels separately, at a cost that depends more on the number of rows than on their length.
inline HogelRange row_tile(const LightFieldGrid& grid, bool along_t = false) {
    const std::size_t hogels = default_tile(grid).hogels();
    const std::size_t extent_along = along_t ? grid.hogels_t : grid.hogels_s,
                      extent_across = along_t ? grid.hogels_s : grid.hogels_t;
    const std::size_t length = std::min(extent_along, hogels),
                      rows = std::clamp<std::size_t>(hogels / length, 1, extent_across);
    return along_t ? HogelRange{0, 0, rows, length} : HogelRange{0, 0, length, rows};
}

}  // namespace hogel::render
