// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/display_value.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "hogel/image.h"

namespace hogel::image {
namespace {

TEST(DisplayValue, is_that_of_the_curve_for_any_number) {
    // Every 61st float from 0 to 2, and all of them around the steps.
    for (std::uint32_t bits = 0; bits <= std::bit_cast<std::uint32_t>(2.0f); bits += 61) {
        const auto x = std::bit_cast<float>(bits);
        ASSERT_EQ(display_value(x), plain_display_value(x)) << x;
    }
    for (int value = 0; value < 255; ++value) {
        const auto step = std::bit_cast<std::uint32_t>(srgb_decode((static_cast<float>(value) + 0.5f) / 255));
        for (std::uint32_t bits = step - 64; bits < step + 64; ++bits) {
            const auto x = std::bit_cast<float>(bits);
            ASSERT_EQ(display_value(x), plain_display_value(x)) << x;
        }
    }
}

TEST(DisplayValue, clamps_what_no_display_shows) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float dark : {-infinity, -1.0f, -0.0f, 0.0f, 1e-38f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_EQ(display_value(dark), 0) << dark;
    for (const float bright : {1.0f, 1.5f, 1e30f, infinity}) EXPECT_EQ(display_value(bright), 255) << bright;
}

}  // namespace
}  // namespace hogel::image
