// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::render {

/// Returns the spacing in metres of the radiance cache's points on each triangle of a scene, for the rays of this light
/// field: `share` times the smallest width of a sample anywhere on the triangle. The width is the larger of the pitch
/// of the hogels and the distance ζ ΔU between the rays of one hogel, at the triangle's point nearest to the hologram
/// plane. Also valid on the sides of a hemicube, where rays of a hogel are nowhere closer than on the front.
std::vector<float> cache_spacing(const ShadedScene& scene, const LightFieldGrid& front, double share);

}  // namespace hogel::render
