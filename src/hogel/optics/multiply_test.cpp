// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/multiply.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "hogel/core/test_targets.h"

namespace hogel::optics {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(Multiply);

TEST_P(Multiply, vector_and_plain_products_agree) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<std::complex<float>> a(80);
    for (std::complex<float>& value : a) value = {uniform(random), uniform(random)};
    const std::vector<std::complex<float>> b(a.rbegin(), a.rend());
    for (std::size_t count = 0; count <= 70; ++count) {
        std::vector<std::complex<float>> fast(count), plain(count);
        multiply(&a[1], &b[2], fast);
        multiply_plain(&a[1], &b[2], plain);
        for (std::size_t x = 0; x < count; ++x) EXPECT_LT(std::abs(fast[x] - plain[x]), 1e-6f) << count << " " << x;
    }
}

}  // namespace
}  // namespace hogel::optics
