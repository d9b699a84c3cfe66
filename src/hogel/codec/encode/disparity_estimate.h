// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/codec/format/reconstruct.h"
#include "hogel/light_field.h"

namespace hogel::codec::encode {

// Disparities of the blocks of a hogel, estimated from its neighbours in the tile.
struct Estimate {
    std::vector<std::int16_t> disparities;
    float shared = 0;  // fraction of the hogel that its neighbours also show, to within the finest step
};
// @param tile   not modified
Estimate estimate_disparities(const format::TileSetup& setup, LightFieldTile& tile,
                              const format::HogelOrder::Hogel& hogel);

}  // namespace hogel::codec::encode
