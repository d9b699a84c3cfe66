#pragma once

#include <memory>

#include "hogel/codec/tile_coder.h"

namespace hogel {

// The coder "hogel" (docs/codec.md): hogels predicted from each other along their disparities, from far apart to side
// by side.
std::unique_ptr<TileCoder> make_hogel_coder(const LightFieldGrid& grid, const DirectionCross& counted = {});

}  // namespace hogel
