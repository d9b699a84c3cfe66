// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "hogel/scene.h"

namespace hogel::scene {

/// Returns the scale factor of fit_scene() for a scene of this size; infinite if width and height are 0.
inline double fit_scale(const Vec3& size, const Fit& fit) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    return fit.fill * std::min(size.x > 0 ? fit.width / size.x : inf, size.y > 0 ? fit.height / size.y : inf);
}

}  // namespace hogel::scene
