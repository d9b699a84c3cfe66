// SPDX-License-Identifier: Apache-2.0
#include "hogel/math/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hogel/math/bessel.h"

namespace hogel::math {
namespace {

// The integral of x^p over [−h, h] is 2 h^(p+1)/(p+1) for even p and zero for odd p, exactly so up to p = 2n − 1.
TEST(GaussLegendre, is_exact_for_polynomials_up_to_its_degree) {
    for (std::size_t count : {1u, 2u, 3u, 8u, 33u}) {
        const double half = 0.9;
        const Quadrature quadrature = gauss_legendre(count, half);
        ASSERT_EQ(quadrature.points.size(), count);
        const auto sum = [&](std::size_t power) {
            double total = 0;
            for (std::size_t i = 0; i < count; ++i)
                total += quadrature.weights[i] * std::pow(quadrature.points[i], static_cast<double>(power));
            return total;
        };
        const auto integral = [&](std::size_t power) {
            const auto next = static_cast<double>(power + 1);
            return power % 2 == 1 ? 0.0 : 2 * std::pow(half, next) / next;
        };
        for (std::size_t power = 0; power < 2 * count; ++power) EXPECT_NEAR(sum(power), integral(power), 1e-12);
        if (count <= 3) {
            EXPECT_GT(integral(2 * count) - sum(2 * count), 1e-2);
        }
    }
}

TEST(BesselI0, is_that_of_the_standard_library) {
    for (double x : {-7.04, 0.0, 1e-9, 0.5, 3.0, 7.04, 20.0})
        EXPECT_NEAR(bessel_i0(x) / std::cyl_bessel_i(0.0, std::abs(x)), 1, 1e-14) << x;
}

}  // namespace
}  // namespace hogel::math
