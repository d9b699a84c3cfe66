#pragma once

#include <algorithm>

#include "hogel/lightfield/light_field.h"

namespace hogel {

/// A tile about as large as default_tile, but as wide as may be: for renderers that treat each row of hogels by itself,
/// at a cost that grows with rows more than with columns.
inline HogelRange row_tile(const LightFieldGrid& grid) {
    const std::size_t hogels = default_tile(grid).hogels();
    const std::size_t columns = std::min(grid.hogels_s, hogels);
    return {0, 0, columns, std::clamp<std::size_t>(hogels / columns, 1, grid.hogels_t)};
}

}  // namespace hogel
