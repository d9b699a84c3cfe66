// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace hogel::math {

/// Returns an element of the orthonormal DCT-II of n points: c_k = Σ_j dct_element(n, k, j) f_j.
inline double dct_element(std::size_t n, std::size_t k, std::size_t j) {
    const auto points = static_cast<double>(n);
    const double angle = std::numbers::pi * static_cast<double>(k * (2 * j + 1)) / (2 * points);
    return std::cos(angle) * std::sqrt((k == 0 ? 1 : 2) / points);
}

}  // namespace hogel::math
