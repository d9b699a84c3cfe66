// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/compress.h"

namespace hogel::codec {

// Returns the coder "hogel" (docs/codec.md), which predicts hogels from each other along disparities.
// @param counted   directions included in the error
std::unique_ptr<TileCoder> make_hogel_coder(const LightFieldGrid& grid, const DirectionCross& counted = {});

}  // namespace hogel::codec
