// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hogel/shading.h"

namespace hogel::shading {

/// The direction, away from the viewer, of the ray through the middle of the hologram and a point. Not of unit length.
inline Vec3 ray_through_middle(Vec3 point) {
    return point.z == 0 ? Vec3{0, 0, -1} : (point.z < 0 ? 1.0 : -1.0) * point;
}

/// The scene with those triangles of double-sided materials turned, corners and normals, whose back is seen by an eye
/// in front of the middle of the hologram, five times as far away as the scene is wide or high, so that each shows the
/// light on the side that is seen; none where there are no such triangles. Backs that others hide, as in all of a
/// closed surface, stay: near its outline some rays see a front that the eye does not see.
/// @param shaded  the geometry of the scene; only its triangles stay
std::optional<Scene> with_seen_sides(const Scene& scene, const ShadedScene& shaded);

}  // namespace hogel::shading
