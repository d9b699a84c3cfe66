// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/shading.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// A caster of all triangles with both sides, numbered as in the scene, for light.
trace::RayCaster all_triangles(const ShadedScene& scene);

/// Gives a caster the visible sides of a scene's triangles (ShadedScene::fronts_only), reusing its memory.
void set_seen_triangles(trace::RayCaster& caster, const ShadedScene& scene);

}  // namespace hogel::shading
