// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/compress.h"

namespace hogel::codec {

// The coder "hogel", and what is left exactly ("lossless": every bit of every float comes back) or up to an error
// ("bounded": |f − f'| <= max_error, and what is not finite comes back as it is). The step is that of the prediction:
// how much of the work is the coder's and how much is left is a matter of size alone.
std::unique_ptr<TileCoder> make_lossless_coder(const LightFieldGrid& grid, const DirectionCross& counted);
// @param max_error   for encode(); tiles know their own
std::unique_ptr<TileCoder> make_bounded_coder(const LightFieldGrid& grid, const DirectionCross& counted,
                                              double max_error);

}  // namespace hogel::codec
