// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/geometry.h"

namespace hogel::scene {

/// Triangulates a simple, possibly concave polygon of n corners into n − 2 index triples of the same orientation, by
/// ear clipping in its mean plane. Results for self-intersecting polygons are arbitrary. Cost: O(n²).
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3> polygon);

}  // namespace hogel::scene
