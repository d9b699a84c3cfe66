// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/compress.h"

namespace hogel::codec::baselines {

// The coders of [K] chapter 4: a transform over all four dimensions of each colour channel of a tile, whose
// coefficients go into a zerotree coder or, for the windowed DCT, into JPEG in four dimensions.
// Bytes of a tile: for each channel the length as 32 bits, and the coder's stream.
// All throw Error(usage) for a transform that does not exist or does not suit the coder.
std::unique_ptr<TileCoder> make_threepass(const CodingMethod& method, const LightFieldGrid& grid,
                                          const DirectionCross& counted);
std::unique_ptr<TileCoder> make_ezw(const CodingMethod& method, const LightFieldGrid& grid,
                                    const DirectionCross& counted);
std::unique_ptr<TileCoder> make_jpeg4d(const CodingMethod& method, const LightFieldGrid& grid,
                                       const DirectionCross& counted);
std::unique_ptr<TileCoder> make_fringes(const CodingMethod& method, const LightFieldGrid& grid,
                                        const DirectionCross& counted);

}  // namespace hogel::codec::baselines
