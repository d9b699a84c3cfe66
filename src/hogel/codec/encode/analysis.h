// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/codec/format/reconstruct.h"
#include "hogel/light_field.h"

namespace hogel::codec::encode {

// What the encoder decides.

// What a bit is worth, in squared steps.
constexpr float bit_worth = 0.18f;

// The disparity of each block of a hogel, from how its neighbours in the tile show it.
struct Estimate {
    std::vector<std::int16_t> disparities;
    float shared = 0;  // how much of the hogel its neighbours show as it does, to within the finest step: 0 to 1
};
// @param tile   stays as it is
Estimate estimate_disparities(const format::TileSetup& setup, LightFieldTile& tile,
                              const format::HogelOrder::Hogel& hogel);

// Decides on all blocks of a hogel and makes its picture, of which there is the memory, as a decoder will have it.
// `estimated` may be empty. Candidates are returned too.
format::CodedHogel analyse(const format::TileSetup& setup, std::size_t hogel, const format::Picture& source,
                           const std::vector<const format::Block*>& moved, const std::vector<format::Block>* beside,
                           const std::vector<std::int16_t>& estimated, std::vector<format::Picture>& pictures);

}  // namespace hogel::codec::encode
