// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "hogel/array.h"
#include "hogel/math/fourier/plan.h"

/// Helpers for tests of Fourier transforms.
namespace hogel::math::fourier {

using Line = std::vector<std::complex<float>>;
using ExactLine = std::vector<std::complex<double>>;

inline Line noise(std::size_t length, std::uint32_t seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    Line values(length);
    for (std::complex<float>& value : values) value = {normal(random), normal(random)};
    return values;
}

inline ExactLine exact(const Line& line) { return {line.begin(), line.end()}; }

/// Returns the root mean square error, relative to the root mean square of the expected values.
inline double relative_error(const std::complex<float>* values, const ExactLine& expected, std::size_t stride = 1) {
    double error = 0, power = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        error += std::norm(std::complex<double>(values[i * stride]) - expected[i]);
        power += std::norm(expected[i]);
    }
    return power > 0 ? std::sqrt(error / power) : std::sqrt(error);
}

/// Returns the allowed error for a length. A convolution contains two transforms.
inline double allowed_error(std::size_t length) { return is_smooth(length) ? 5e-7 : 2e-6; }

}  // namespace hogel::math::fourier
