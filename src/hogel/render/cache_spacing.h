// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::render {

/// How far apart on each triangle points of its light may lie for rays of this light field (see LightCache): `share`
/// times the smallest width that a sample has anywhere on it, which is a hogel's pitch or, if that is more, the
/// distance of one hogel's rays, ζ ΔU, where the triangle is nearest to the hologram plane. Holds on the sides of a
/// hemicube too, where rays of a hogel are nowhere closer than on the front.
std::vector<float> cache_spacing(const ShadedScene& scene, const LightFieldGrid& front, double share);

}  // namespace hogel::render
