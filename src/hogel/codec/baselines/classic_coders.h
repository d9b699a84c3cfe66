// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/codec/tile_coder.h"

namespace hogel::codec::baselines {

// The coders of [K] chapter 4: a transform over all four dimensions of each colour channel of a tile, interleaved, and
// its coefficients into a zerotree coder or, for the windowed DCT, JPEG in four dimensions.
// Bytes of a tile: for each channel the length as 32 bits, and the coder's stream.
// @param version   of the format
std::unique_ptr<TileCoder> make_classic_coder(const CodingMethod& method, const format::DirectionCross& counted,
                                              std::uint32_t version);

}  // namespace hogel::codec::baselines
