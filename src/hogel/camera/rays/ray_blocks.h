// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/camera.h"
#include "hogel/light_field.h"

namespace hogel::camera::rays {

/// A block of cells between hogels, and the hogels at the cells' corners.
struct Block {
    HogelRange cells, hogels;
};

/// Bytes of the hogels of a block, unless a single one takes more.
constexpr std::size_t max_block_bytes = std::size_t{64} << 20;

/// The blocks in which photographs by rays take a face. They depend on the sampling alone, so that sums have the same
/// order for every source.
std::vector<Block> blocks(const LightFieldGrid& grid);

/// Throws Error(usage) for a camera that makes no sense, or whose plane in focus is tilted.
void require_ray_camera(const Camera& camera);

}  // namespace hogel::camera::rays
