// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/low_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hogel::optics {
namespace {

// The frequency response, by a fine sum over the kernel.
double response(double frequency) {
    const int fine = 64;
    double sum = 0;
    for (int i = -5 * fine; i <= 5 * fine; ++i) {
        const double x = static_cast<double>(i) / fine;
        sum += LowPass::at(x) * std::cos(2 * std::numbers::pi * frequency * x) / fine;
    }
    return sum;
}

TEST(LowPass, passes_half_the_band_and_stops_its_aliases) {
    for (double f = 0; f <= LowPass::pass; f += 0.01) EXPECT_NEAR(response(f), 1, 4e-4) << f;
    for (double f = LowPass::stop; f < 8; f += 0.01) EXPECT_NEAR(response(f), 0, 4e-4) << f;
    EXPECT_NEAR(response(0.5), 0.5, 1e-3);
}

}  // namespace
}  // namespace hogel::optics
