// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hogel/light_field.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/row_axes.h"

namespace hogel::render::epi {

/// The first sample of an epipolar plane, by the numbers that RowAxes gives to hogels and directions.
struct FirstSample {
    std::size_t slow_hogel, fast_hogel, slow_direction;
};

/// Places the values of epipolar planes in a tile. Where directions of a plane lie side by side in the tile, they are
/// written there at once; where they lie apart, on the left and the right side of a hemicube, by way of a buffer.
class TileWriter {
  public:
    TileWriter(const LightFieldGrid& grid, const RowAxes& axes) : grid_(grid), axes_(axes) {}

    /// Where the values of a plane are to be written: valid until the next call, and to be followed by finish().
    PlaneOutput begin(LightFieldTile& tile, const EpipolarPlane& plane, const FirstSample& first);
    /// With the same arguments once all values are written: empties the buffer into the tile.
    void finish(LightFieldTile& tile, const EpipolarPlane& plane, const FirstSample& first) const;

  private:
    bool is_wanted(const LightFieldTile& tile, std::size_t value) const {
        return value == 3 ? tile.depth.size() > 0 : value < grid_.channels;
    }

    LightFieldGrid grid_;
    RowAxes axes_;
    std::array<std::vector<float>, 4> buffer_;  // by values, column by column
};

}  // namespace hogel::render::epi
