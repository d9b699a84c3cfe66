#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "hogel/codec/colour_internal.h"
#include "hogel/codec/reconstruct_internal.h"
#include "hogel/lightfield/light_field.h"

namespace hogel {

// A hogel's channels, filled up to whole blocks by their last samples, apart in luminance and chrominance. `s` and `t`
// count within the tile.
Picture picture_of(const LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t);

// The way back, row by row: use(channel, v, samples).
template <class Use>
void for_each_row(const Picture& picture, const TileSetup& setup, Use&& use) {
    std::array<std::vector<float>, 3> row;
    for (std::size_t v = 0; v < setup.height; ++v) {
        for (std::size_t c = 0; c < picture.size(); ++c) {
            const float* in = &picture[c].samples[v * picture[c].width];
            row[c].assign(in, in + setup.width);
        }
        if (picture.size() == 3) join_colours(row[0], row[1], row[2]);
        for (std::size_t c = 0; c < picture.size(); ++c) use(c, v, row[c]);
    }
}

}  // namespace hogel
