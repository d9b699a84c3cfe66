// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/pictures.h"

namespace hogel::codec::format {

Picture copy_of(const LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t) {
    Picture picture = setup.blank();
    for (std::size_t c = 0; c < picture.size(); ++c)
        for (std::size_t v = 0; v < picture[c].height; ++v) {
            const float* in = &tile.radiance(c, t, s, std::min(v, setup.height - 1), 0);
            float* out = &picture[c].samples[v * picture[c].width];
            std::copy_n(in, setup.width, out);
            std::fill(out + setup.width, out + picture[c].width, in[setup.width - 1]);
        }
    return picture;
}

Picture picture_of(const LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t) {
    Picture picture = copy_of(tile, setup, s, t);
    if (picture.size() == 3) separate_colours(picture[0].samples, picture[1].samples, picture[2].samples);
    return picture;
}

Picture as_in_tile(LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t) {
    Picture picture;
    for (std::size_t c = 0; c < setup.grid.channels; ++c)
        picture.emplace_back(setup.width, setup.height, &tile.radiance(c, t, s, 0, 0));
    return picture;
}

}  // namespace hogel::codec::format
