// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/shading.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// The share of a light that arrives at each vertex of a scene, numbered as in the shaded scene: 1 or 0 by a shadow ray
/// or, on triangles through which the edge of a shadow goes, a mean over the triangles around the vertex, so that
/// interpolation gives a smooth edge instead of stairs. Triangles finer than a hundredth of the scene have no such
/// stairs. Zero where the surface faces away and on meshes that bring their radiance.
/// @param caster  as from shadow_caster()
std::vector<float> vertex_visibility(const Scene& scene, const ShadedScene& shaded, const trace::RayCaster& caster,
                                     const Light& light);

}  // namespace hogel::shading
