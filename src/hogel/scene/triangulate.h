// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/geometry.h"

namespace hogel::scene {

/// Cuts a simple polygon in space into n − 2 triangles of its n corners (indices into `polygon`, turning the way the
/// polygon turns) by clipping ears in the plane that it lies in on average. Concave polygons may have any shape; of one
/// that crosses itself the result covers something, without guarantee. Cost: n² at worst.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3> polygon);

}  // namespace hogel::scene
