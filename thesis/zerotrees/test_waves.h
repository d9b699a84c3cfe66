// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>
#include <string_view>
#include <vector>

#include "thesis/wavelets/transform.h"

namespace hogel::zerotrees {

// Returns the coefficients of a wave across all axes, with an edge and a little noise.
inline std::vector<float> transformed_waves(const wavelets::Pyramid& pyramid, std::string_view transform) {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    const std::vector<std::size_t> strides = pyramid.strides();
    std::vector<float> values(pyramid.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        double phase = 0;
        for (std::size_t axis = 0; axis < strides.size(); ++axis)
            phase += static_cast<double>(i / strides[axis] % pyramid.shape()[axis]) *
                     (0.11 + 0.07 * static_cast<double>(axis));
        values[i] = static_cast<float>(std::sin(phase) + (phase > 2 ? 0.5 : 0)) + 0.01f * normal(random);
    }
    wavelets::transform(transform).forward(pyramid, values);
    return values;
}

}  // namespace hogel::zerotrees
