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

// Returns the channels of a hogel of a tile, padded to whole blocks by their last samples, as luminance and
// chrominance.
Picture picture_of(const LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t);
// Returns the same as red, green and blue.
Picture copy_of(const LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t);
// Returns a picture that refers to the hogel in the tile. Hogels must consist of whole blocks. Must not outlive the
// tile.
Picture as_in_tile(LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t);

// Calls use(channel, v, samples) for the rows of a picture, as red, green and blue and without padding.
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
