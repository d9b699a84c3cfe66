// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/field.h"
#include "hogel/geometry.h"

namespace hogel::stereogram {

struct PointSource {
    Vec3 position;         ///< z = −ζ: behind the hologram z < 0, in front of it z > 0
    double amplitude = 1;  ///< of the spherical wave at unit distance
    double phase = 0;      ///< radians, at the point
};

/// Returns the exact Huygens sum of spherical waves, a e^{±ikr}/r, on a plane. A point in front of the plane is the
/// focus of a converging wave. Source: [K] (3.5). Throws Error(usage) for a point on the plane z = 0.
Field point_hologram(std::span<const PointSource> points, const FieldGrid& grid);

}  // namespace hogel::stereogram
