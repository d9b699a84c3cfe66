// SPDX-License-Identifier: Apache-2.0
#include "hogel/math/split_fft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "hogel/array.h"
#include "hogel/core/test_targets.h"
#include "hogel/error.h"

namespace hogel::math {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(SplitFourier);

// Both directions of every length are sums over the line.
TEST_P(SplitFourier, transforms_are_sums) {
    for (const std::size_t size : {1, 2, 12, 35, 64, 130, 225}) {
        const SplitFft fft(size);
        for (const bool exchanged : {false, true}) {
            Array<float, 1> lines({size * SplitFft::row}), before({size * SplitFft::row});
            for (std::size_t i = 0; i < lines.size(); ++i)
                before(i) = lines(i) = static_cast<float>(std::sin(1.7 * double(i) * double(i % 97)));
            fft.transform(lines.data());
            const std::size_t re = exchanged ? 16 : 0, im = 16 - re;
            for (const std::size_t line : {0, 7, 15})
                for (std::size_t f = 0; f < size; f += 1 + size / 9) {
                    std::complex<double> sum = 0;
                    for (std::size_t i = 0; i < size; ++i) {
                        const double angle = 2 * std::numbers::pi * double(i * f % size) / double(size);
                        sum += std::complex<double>(before(i * 32 + re + line), before(i * 32 + im + line)) *
                               std::polar(1.0, exchanged ? angle : -angle);
                    }
                    const float* found = &lines(fft.place(f) * 32 + line);
                    EXPECT_NEAR(found[re], sum.real(), 1e-5 * std::sqrt(double(size)) + 1e-5) << size << " " << f;
                    EXPECT_NEAR(found[im], sum.imag(), 1e-5 * std::sqrt(double(size)) + 1e-5) << size << " " << f;
                }
        }
    }
}

TEST(SplitFft, refuses_large_prime_factors) { EXPECT_THROW(SplitFft(17), Error); }

}  // namespace
}  // namespace hogel::math
