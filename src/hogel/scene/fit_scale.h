// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "hogel/scene.h"

namespace hogel::scene {

/// By what fit_scene() multiplies the lengths of a scene of this size; infinite without width and height.
inline double fit_scale(const Vec3& size, const Fit& fit) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    return fit.fill * std::min(size.x > 0 ? fit.width / size.x : inf, size.y > 0 ? fit.height / size.y : inf);
}

}  // namespace hogel::scene
