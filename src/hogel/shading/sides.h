// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hogel/shading.h"

namespace hogel::shading {

/// Returns the direction, not normalised, away from the viewer, of the ray through the hologram's middle and a point.
inline Vec3 ray_through_middle(Vec3 point) {
    return point.z == 0 ? Vec3{0, 0, -1} : (point.z < 0 ? 1.0 : -1.0) * point;
}

/// Returns the scene with the back-facing triangles of double-sided materials turned, corners and normals, so that each
/// shows the light on its visible side; null if there are none. The viewpoint is in front of the middle of the
/// hologram, at five times the width or height of the scene. Occluded backs, as in all of a closed surface, are not
/// turned: near its outline some rays see a front that is invisible from the viewpoint.
/// @param shaded  geometry of the scene; only its triangles are kept
std::optional<Scene> with_seen_sides(const Scene& scene, const ShadedScene& shaded);

}  // namespace hogel::shading
