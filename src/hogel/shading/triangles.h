// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/shading.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// All triangles, both sides of them and numbered as in the scene: what light meets.
trace::RayCaster all_triangles(const ShadedScene& scene);

/// Gives a caster the sides of a scene's triangles that are seen (ShadedScene::fronts_only), in the memory that it has.
void set_seen_triangles(trace::RayCaster& caster, const ShadedScene& scene);

}  // namespace hogel::shading
