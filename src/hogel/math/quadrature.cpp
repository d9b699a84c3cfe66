// SPDX-License-Identifier: Apache-2.0
#include "hogel/math/quadrature.h"

#include <cmath>
#include <numbers>

namespace hogel::math {

Quadrature gauss_legendre(std::size_t count, double half) {
    Quadrature result;
    const auto n = static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        double x = -std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5)), slope = 0;
        for (int step = 0; step < 100; ++step) {
            double p = 1, previous = 0;
            for (std::size_t k = 1; k <= count; ++k) {
                const auto degree = static_cast<double>(k);
                const double next = ((2 * degree - 1) * x * p - (degree - 1) * previous) / degree;
                previous = p;
                p = next;
            }
            slope = n * (x * p - previous) / (x * x - 1);
            const double change = p / slope;
            x -= change;
            if (std::abs(change) < 1e-15) break;
        }
        result.points.push_back(half * x);
        result.weights.push_back(half * 2 / ((1 - x * x) * slope * slope));
    }
    return result;
}

}  // namespace hogel::math
