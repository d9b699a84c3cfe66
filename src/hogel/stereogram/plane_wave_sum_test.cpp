// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/plane_wave_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hogel::stereogram {
namespace {

class PlaneWaves : public testing::TestWithParam<std::size_t> {};

TEST_P(PlaneWaves, equal_a_direct_sum) {
    const std::size_t n = GetParam();
    const PlaneWaveSum sum(n);
    Array<std::complex<float>, 2> spectrum = sum.make_spectrum(), samples({n, n});
    const double frequencies[][2] = {{0, 0}, {0.5, -0.5}, {-0.4993, 0.123}, {0.3141, 0.4999}, {1e-5, -0.25}};
    Array<std::complex<double>, 2> expected({n, n});
    double amplitude = 1;
    for (const auto& f : frequencies) {
        sum.add(std::complex<float>(float(amplitude), 0.5f), f[0], f[1], spectrum);
        for (std::size_t q = 0; q < n; ++q)
            for (std::size_t p = 0; p < n; ++p) {
                const double x = double(p) - 0.5 * double(n - 1), y = double(q) - 0.5 * double(n - 1);
                expected(q, p) += std::complex<double>(amplitude, 0.5) *
                                  std::polar(1.0, 2 * std::numbers::pi * (f[0] * x + f[1] * y));
            }
        amplitude *= -1.3;
    }
    sum.transform(spectrum, samples);
    for (std::size_t i = 0; i < n * n; ++i)
        ASSERT_LT(std::abs(std::complex<double>(samples.data()[i]) - expected.data()[i]), 2e-4) << i;
}

INSTANTIATE_TEST_SUITE_P(Sides, PlaneWaves, testing::Values(1, 2, 5, 16, 33));

}  // namespace
}  // namespace hogel::stereogram
