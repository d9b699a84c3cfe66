// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/compress.h"

namespace hogel::codec {

// The coder "hogel" as prediction, and the residual of each sample: exactly ("lossless": every bit of every float comes
// back) or within an error ("bounded": |f − f'| <= max_error, and what is not finite comes back as it is). The step is
// that of the prediction; it changes the size of a tile but not its quality.
std::unique_ptr<TileCoder> make_lossless_coder(const LightFieldGrid& grid, const DirectionCross& counted);
// @param max_error   for encode(); decode() reads it from the tile
std::unique_ptr<TileCoder> make_bounded_coder(const LightFieldGrid& grid, const DirectionCross& counted,
                                              double max_error);

}  // namespace hogel::codec
