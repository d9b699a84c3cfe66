// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/shading.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// A caster of all triangles with both sides, numbered as in the scene, for light. Masks have their holes; a surface
/// that blends is there where it is at least half opaque. The caster of a scene with layers must not outlive the scene.
trace::RayCaster all_triangles(const ShadedScene& scene);

/// The caster for the shadows of a scene: of all triangles if a light casts shadows, else of none. Throws
/// Error(not_built_in) where there are shadows and no rays.
/// @param model  the name of the shading model, for that message
trace::RayCaster shadow_caster(const Scene& scene, const ShadedScene& shaded, const char* model);

/// Gives a caster the visible sides of a scene's triangles (ShadedScene::fronts_only), reusing its memory.
void set_seen_triangles(trace::RayCaster& caster, const ShadedScene& scene);

}  // namespace hogel::shading
