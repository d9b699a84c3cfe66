// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace hogel::camera {

/// Returns Σ_j e^{2πiy(j−c)/n} over n samples j with the middle c = (n − 1)/2: the light of a wave in a window of n
/// samples, y cycles per window off its direction.
inline double dirichlet(double y, std::size_t samples) {
    const auto n = static_cast<double>(samples);
    const double below = std::sin(std::numbers::pi * y / n);
    if (std::abs(below) > 1e-9) return std::sin(std::numbers::pi * y) / below;
    const double turns = std::round(y / n);  // the limit there is ±n
    return std::fmod(std::abs(turns) * (n - 1), 2) == 0 ? n : -n;
}

}  // namespace hogel::camera
