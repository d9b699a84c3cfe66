// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hogel/compress.h"

namespace hogel::codec::format {

// Light fields with a single row of directions, as those with horizontal parallax alone have, would leave most of a
// coder's blocks of directions empty. So what lies one above the other is gathered: a tile of S × T hogels with n_U × 1
// directions is coded as one of S × 1 hogels with n_U × T. With a single column of directions, 1 × n_V, it is coded as
// one of T × 1 hogels with n_V × S.

// Whether all faces have a single row of directions and several rows of hogels, or a single column and several columns.
bool can_gather(std::span<const LightFieldGrid> faces);

// The coder of the tiles of a face in a layout: what `coder_of` makes, or where they are gathered, a coder made of
// those for each light field that they are gathered into.
using CoderOf = std::function<std::unique_ptr<TileCoder>(const LightFieldGrid&)>;
std::unique_ptr<TileCoder> coder_in_layout(StreamLayout layout, const LightFieldGrid& grid, CoderOf coder_of);

}  // namespace hogel::codec::format
