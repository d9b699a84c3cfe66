// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "hogel/scene.h"

namespace hogel::shading {

/// How a light illuminates a point.
struct Illumination {
    Vec3 to_light;  ///< unit length; zero at the position of a point light, which does not light that point
    double distance = std::numeric_limits<double>::infinity();
    double falloff = 1;  ///< irradiance at normal incidence per intensity
};

inline Illumination illuminate(const Light& light, Vec3 point) {
    if (light.kind == Light::Kind::directional) return {-normalize(light.direction)};
    const Vec3 to_light = light.position - point;
    const double distance = length(to_light);
    if (distance == 0) return {{}, 0, 0};
    return {to_light / distance, distance, 1 / (distance * distance)};
}

}  // namespace hogel::shading
