// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/compress.h"

namespace hogel::codec {

// The coder "hogel" (docs/codec.md): hogels are predicted from each other along disparities.
// @param counted   the directions whose errors count
std::unique_ptr<TileCoder> make_hogel_coder(const LightFieldGrid& grid, const DirectionCross& counted = {});

}  // namespace hogel::codec
