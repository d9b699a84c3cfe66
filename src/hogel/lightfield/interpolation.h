// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hogel::lightfield {

// std::lerp would check for infinities.
inline float mix(float a, float b, float weight) { return a + (b - a) * weight; }

// Linear interpolation between neighbours of a row of samples. A sample represents the cell around it: the row extends
// half a cell beyond the last sample, and the value is zero beyond.
struct Interpolation {
    std::size_t low = 0;
    float high_weight = 0;
    bool outside = true;

    Interpolation(double index, std::size_t count) {
        const double last = static_cast<double>(count) - 1;
        if (!(index >= -0.5 && index <= last + 0.5)) return;
        outside = false;
        const double clamped = std::clamp(index, 0.0, last);
        low = static_cast<std::size_t>(std::clamp(std::floor(clamped), 0.0, std::max(last - 1, 0.0)));
        high_weight = static_cast<float>(clamped - static_cast<double>(low));
    }
    // Returns the upper neighbour, or the same sample if there is only one.
    std::size_t high(std::size_t count) const { return std::min(low + 1, count - 1); }
    // Returns the nearer neighbour.
    std::size_t nearest() const { return high_weight < 0.5f ? low : low + 1; }
};

}  // namespace hogel::lightfield
