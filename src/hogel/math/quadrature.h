// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace hogel::math {

struct Quadrature {
    std::vector<double> points, weights;
};

/// Returns the Gauss–Legendre quadrature of `count` points over [−half, half], exact for polynomials of degree 2 count
/// − 1. Finds the zeros of the Legendre polynomial by Newton's method.
Quadrature gauss_legendre(std::size_t count, double half);

}  // namespace hogel::math
