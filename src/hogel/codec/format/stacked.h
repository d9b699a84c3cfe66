// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hogel/compress.h"

namespace hogel::codec::format {

// In a light field with a single row of directions (horizontal parallax only), most of each block of directions would
// be empty. Therefore rows of hogels are stacked into an epipolar image: a tile of S × T hogels with n_U × 1 directions
// is coded as S × 1 hogels with n_U × T directions; a tile with a single column, 1 × n_V, as T × 1 hogels with n_V × S
// directions.

// Returns whether all faces have a single row of directions and several rows of hogels, or a single column and several
// columns.
bool can_stack(std::span<const LightFieldGrid> faces);

// Returns the coder of a face's tiles in a layout: coder_of(face), or for `stacked` a coder that stacks each tile and
// codes it with coder_of(stacked grid).
using CoderOf = std::function<std::unique_ptr<TileCoder>(const LightFieldGrid&)>;
std::unique_ptr<TileCoder> coder_in_layout(StreamLayout layout, const LightFieldGrid& grid, CoderOf coder_of);

}  // namespace hogel::codec::format
