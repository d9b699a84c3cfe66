// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::render {

/// The spacing of the radiance cache's points on each triangle for rays of this light field, in metres: `share` times
/// the smallest width that a sample has anywhere on the triangle. That width is the larger of a hogel's pitch and the
/// distance ζ ΔU between the rays of one hogel where the triangle is nearest to the hologram plane. It is valid for the
/// sides of a hemicube too, where rays of a hogel are nowhere closer than on the front.
std::vector<float> cache_spacing(const ShadedScene& scene, const LightFieldGrid& front, double share);

}  // namespace hogel::render
