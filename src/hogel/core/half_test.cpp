// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hogel/core/test_targets.h"

#include "hogel/core/half.h"

namespace hogel::core {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(Half);

// IEEE 754: 1 sign bit, 5 bits of exponent with bias 15, 10 of fraction.
float value_by_definition(unsigned half) {
    const int sign = half & 0x8000 ? -1 : 1, exponent = (half >> 10) & 31, fraction = half & 1023;
    if (exponent == 31) return fraction ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(sign) * INFINITY;
    const double value = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    return static_cast<float>(sign * value);
}

TEST_P(Half, all_65536_values_are_those_of_IEEE_754_and_convert_back) {
    std::vector<std::uint16_t> halves(65536), back(65536);
    for (unsigned h = 0; h < 65536; ++h) halves[h] = static_cast<std::uint16_t>(h);
    std::vector<float> values(65536);
    to_float(halves.data(), values.data(), values.size());
    to_half(values.data(), back.data(), back.size());
    for (unsigned h = 0; h < 65536; ++h) {
        const float expected = value_by_definition(h);
        if (std::isnan(expected)) {
            ASSERT_TRUE(std::isnan(values[h]));
            ASSERT_EQ(back[h] & 0x7c00, 0x7c00);
            ASSERT_NE(back[h] & 0x3ff, 0);
        } else {
            ASSERT_EQ(values[h], expected) << h;
            ASSERT_EQ(std::signbit(values[h]), std::signbit(expected)) << h;
            ASSERT_EQ(back[h], h);
        }
    }
}

TEST_P(Half, a_number_that_is_not_finite_is_found_anywhere) {
    for (std::size_t n = 1; n < 70; ++n) {
        std::vector<std::uint16_t> halves(n, 0xfbff);  // the lowest finite number
        std::vector<float> values(n);
        ASSERT_TRUE(to_float(halves.data(), values.data(), n)) << n;
        for (std::size_t i = 0; i < n; ++i)
            for (const std::uint16_t bad : {0x7c00, 0xfc00, 0x7c01, 0xffff}) {
                halves[i] = bad;
                ASSERT_FALSE(to_float(halves.data(), values.data(), n)) << n << ' ' << i << ' ' << bad;
                halves[i] = 0xfbff;
            }
    }
}

TEST(Half, rounds_to_nearest_and_ties_to_even) {
    for (unsigned h = 0; h < 0x7c00; ++h) {
        // The half after the largest would be 65536, so from the midpoint 65520 on the result is infinite.
        const double low = value_by_definition(h), high = h == 0x7bff ? 65536 : value_by_definition(h + 1);
        const auto middle = static_cast<float>((low + high) / 2);
        ASSERT_EQ(middle, (low + high) / 2);
        ASSERT_EQ(half_of(middle), h % 2 == 0 ? h : h + 1);
        ASSERT_EQ(half_of(std::nextafter(middle, 0.0f)), h);
        ASSERT_EQ(half_of(std::nextafter(middle, INFINITY)), h + 1);
        ASSERT_EQ(half_of(-middle), half_of(middle) | 0x8000);
    }
}

TEST(Half, infinities_and_not_a_number) {
    EXPECT_EQ(half_of(INFINITY), 0x7c00);
    EXPECT_EQ(half_of(-INFINITY), 0xfc00);
    EXPECT_EQ(half_of(std::numeric_limits<float>::max()), 0x7c00);
    EXPECT_EQ(half_of(std::numeric_limits<float>::denorm_min()), 0);
    EXPECT_EQ(half_of(-0.0f), 0x8000);
    // A NaN whose fraction lies in the bits that are dropped is still a NaN.
    EXPECT_EQ(half_of(std::bit_cast<float>(0x7f800001u)) & 0x7fff, 0x7e00);
}

}  // namespace
}  // namespace hogel::core
