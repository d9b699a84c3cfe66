// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "hogel/codec/format/colour.h"
#include "hogel/codec/format/reconstruct.h"
#include "hogel/light_field.h"

namespace hogel::codec::format {

// A hogel's channels, filled up to whole blocks by their last samples, apart in luminance and chrominance. `s` and `t`
// count within the tile.
Picture picture_of(const LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t);
// The same with its colours.
Picture copy_of(const LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t);
// The same where it lies, of whole blocks; it must not outlive the tile.
Picture as_in_tile(LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t);

// The way back, row by row: use(channel, v, samples).
template <class Use>
void for_each_row(const Picture& picture, const TileSetup& setup, Use&& use) {
    std::array<std::vector<float>, 3> row;
    for (std::size_t v = 0; v < setup.height; ++v) {
        const auto in = [&](std::size_t c) {
            return std::span(picture[c].samples).subspan(v * picture[c].width, setup.width);
        };
        if (picture.size() == 1) {
            use(0, v, in(0));
            continue;
        }
        for (std::size_t c = 0; c < picture.size(); ++c) row[c].assign(in(c).begin(), in(c).end());
        join_colours(row[0], row[1], row[2]);
        for (std::size_t c = 0; c < picture.size(); ++c) use(c, v, std::span<const float>(row[c]));
    }
}

}  // namespace hogel::codec::format
