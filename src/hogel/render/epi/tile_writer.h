// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hogel/light_field.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/row_axes.h"

namespace hogel::render::epi {

/// First sample of an epipolar plane, by the hogel and direction indices of RowAxes.
struct FirstSample {
    std::size_t slow_hogel, fast_hogel, slow_direction;
};

/// Writes the values of epipolar planes to a tile: directly if the directions of a plane are contiguous in the tile, or
/// through a buffer on the left and right sides of a hemicube.
class TileWriter {
  public:
    TileWriter(const LightFieldGrid& grid, const RowAxes& axes) : grid_(grid), axes_(axes) {}

    /// Returns the destination of a plane's values, valid until the next call. Must be followed by finish().
    PlaneOutput begin(LightFieldTile& tile, const EpipolarPlane& plane, const FirstSample& first);
    /// Copies the buffer to the tile. Takes the arguments of begin(), after all values are written.
    void finish(LightFieldTile& tile, const EpipolarPlane& plane, const FirstSample& first) const;

  private:
    bool is_wanted(const LightFieldTile& tile, std::size_t value) const {
        return value == 3 ? tile.depth.size() > 0 : value < grid_.channels;
    }

    LightFieldGrid grid_;
    RowAxes axes_;
    std::array<std::vector<float>, 4> buffer_;  // one per value, column by column
};

}  // namespace hogel::render::epi
