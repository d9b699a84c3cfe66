// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/shading.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// Returns a caster of all triangles, both sides, numbered as in the scene, for light. Masks have holes; a blended
/// surface is solid where its opacity is at least 0.5. A caster of a scene with layers must not outlive the scene.
trace::RayCaster all_triangles(const ShadedScene& scene);

/// Returns the caster for the shadows of a scene: of all triangles if a light casts shadows, else empty. Throws
/// Error(not_built_in) if shadows need rays in a build without ray casting.
/// @param model  name of the shading model, for this error
trace::RayCaster shadow_caster(const Scene& scene, const ShadedScene& shaded, const char* model);

/// Sets a caster to the visible sides of a scene's triangles (ShadedScene::fronts_only), reusing its memory.
void set_seen_triangles(trace::RayCaster& caster, const ShadedScene& scene);

}  // namespace hogel::shading
