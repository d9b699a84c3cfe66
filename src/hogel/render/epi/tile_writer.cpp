// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/tile_writer.h"

namespace hogel::render::epi {

PlaneOutput TileWriter::begin(LightFieldTile& tile, const EpipolarPlane& plane, const FirstSample& first) {
    PlaneOutput out{};
    for (std::size_t i = 0; i < 4; ++i) {
        if (!is_wanted(tile, i)) continue;
        if (axes_.transposed()) {
            buffer_[i].resize(plane.columns * plane.directions);
            out.values[i] = buffer_[i].data();
            out.strides[i] = plane.directions;
        } else {
            const std::size_t t = first.slow_hogel - tile.range.t0, s = first.fast_hogel - tile.range.s0;
            out.values[i] =
                i == 3 ? &tile.depth(t, s, first.slow_direction, 0) : &tile.radiance(i, t, s, first.slow_direction, 0);
            out.strides[i] = grid_.directions();
        }
    }
    return out;
}

void TileWriter::finish(LightFieldTile& tile, const EpipolarPlane& plane, const FirstSample& first) const {
    if (!axes_.transposed()) return;
    const std::size_t t = first.fast_hogel - tile.range.t0, s = first.slow_hogel - tile.range.s0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (!is_wanted(tile, i)) continue;
        for (std::size_t column = 0; column < plane.columns; ++column) {
            float* destination = i == 3 ? &tile.depth(t + column, s, 0, first.slow_direction)
                                        : &tile.radiance(i, t + column, s, 0, first.slow_direction);
            const float* source = buffer_[i].data() + column * plane.directions;
            for (std::size_t k = 0; k < plane.directions; ++k) destination[k * grid_.directions_u] = source[k];
        }
    }
}

}  // namespace hogel::render::epi
