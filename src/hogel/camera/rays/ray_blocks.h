// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/camera.h"
#include "hogel/light_field.h"

namespace hogel::camera::rays {

/// A block of cells between hogels, and the hogels at the corners of the cells.
struct Block {
    HogelRange cells, hogels;
};

/// Maximum bytes of the hogels of a block, unless a single hogel takes more.
constexpr std::size_t max_block_bytes = std::size_t{64} << 20;

/// Returns the blocks of a face for photographs by rays. They depend only on the sampling, so that sums have the same
/// order for every source.
std::vector<Block> blocks(const LightFieldGrid& grid);

/// Throws Error(usage) for an invalid camera or a tilted plane in focus.
void require_ray_camera(const Camera& camera);

}  // namespace hogel::camera::rays
