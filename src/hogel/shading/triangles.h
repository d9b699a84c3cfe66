// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/shading.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// All triangles, numbered as in the scene, for rays to meet (trace/ray_caster.h): for light, both sides of them, or
/// those that are seen.
trace::RayCaster all_triangles(const ShadedScene& scene);
trace::RayCaster seen_triangles(const ShadedScene& scene);

}  // namespace hogel::shading
