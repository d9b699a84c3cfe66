// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hogel/scene.h"

namespace hogel::shading {

/// Illumination of a point by a light.
struct Illumination {
    Vec3 to_light;  ///< unit length; zero at the position of a point light, where `falloff` is 0
    double distance = std::numeric_limits<double>::infinity();
    double falloff = 1;  ///< irradiance at normal incidence per intensity
    double in_cone = 1;  ///< factor of a spot light's cone, included in `falloff`
};

/// Returns the factor of a point light's cone in the direction from a point to the light.
inline double in_cone(const Light& light, Vec3 to_light) {
    if (!(light.outer_cone < std::numbers::pi)) return 1;
    const double outer = std::cos(light.outer_cone), inner = std::cos(std::min(light.inner_cone, light.outer_cone));
    // The minimum width of the edge is that of glTF.
    const double position = (-dot(to_light, light.direction) - outer) / std::max(inner - outer, 1e-3);
    const double factor = std::clamp(position, 0.0, 1.0);
    return factor * factor;
}

inline Illumination illuminate(const Light& light, Vec3 point) {
    if (light.kind == Light::Kind::directional) return {-normalize(light.direction)};
    const Vec3 to_light = light.position - point;
    const double distance = length(to_light);
    if (distance == 0) return {{}, 0, 0, 0};
    const Vec3 towards = to_light / distance;
    const double cone = in_cone(light, towards);
    return {towards, distance, cone / (distance * distance), cone};
}

}  // namespace hogel::shading
