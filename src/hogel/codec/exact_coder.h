// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/compress.h"

namespace hogel::codec {

// Coders that use the coder "hogel" as a prediction and code the residual of each sample: exactly ("lossless"), or
// within a bound ("bounded": |f − f'| <= max_error, non-finite values exactly). The step of the prediction changes the
// size of a tile but not its quality.
std::unique_ptr<TileCoder> make_lossless_coder(const LightFieldGrid& grid, const DirectionCross& counted);
// @param max_error   used by encode(); decode() reads it from the tile
std::unique_ptr<TileCoder> make_bounded_coder(const LightFieldGrid& grid, const DirectionCross& counted,
                                              double max_error);

}  // namespace hogel::codec
