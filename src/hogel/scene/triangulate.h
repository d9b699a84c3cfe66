// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/geometry.h"

namespace hogel::scene {

/// Divides a simple polygon in space into n − 2 triangles of its n corners (indices into `polygon`, in the polygon's
/// orientation) by clipping ears in its mean plane. Polygons may be concave; for a polygon that crosses itself the
/// triangles are arbitrary. Cost: O(n²).
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3> polygon);

}  // namespace hogel::scene
