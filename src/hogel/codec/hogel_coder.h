// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/codec/tile_coder.h"

namespace hogel::codec {

// The coder "hogel" (docs/codec.md): hogels predicted from each other along their disparities, from far apart to side
// by side.
// @param version   of the format
std::unique_ptr<TileCoder> make_hogel_coder(const LightFieldGrid& grid, const format::DirectionCross& counted = {},
                                            std::uint32_t version = latest_version);

}  // namespace hogel::codec
