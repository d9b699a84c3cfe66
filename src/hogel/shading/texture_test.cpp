// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hogel::shading {
namespace {

std::shared_ptr<Image> picture(std::size_t width, std::size_t height, auto&& value) {
    auto image = std::make_shared<Image>(width, height, 1);
    for (std::size_t row = 0; row < height; ++row)
        for (std::size_t column = 0; column < width; ++column) image->pixels(row, column, 0) = value(row, column);
    return image;
}

TEST(Texture, averaged_over_a_large_width_is_its_mean) {
    const auto image =
        picture(13, 7, [](std::size_t row, std::size_t column) { return float(row * row + 3 * column); });
    double mean = 0;
    for (std::size_t i = 0; i < 91; ++i) mean += image->pixels.data()[i] / 91;
    const Texture texture(image, true);
    EXPECT_NEAR(texture.sample({0.3f, 0.8f}, 1e6).r, mean, 1e-4);
    EXPECT_GT(std::abs(Texture(image).sample({0.3f, 0.8f}, 1e6).r - mean), 1);  // point sampled
}

TEST(Texture, averaging_removes_fine_detail_and_keeps_coarse_detail) {
    constexpr std::size_t n = 256;
    const auto image = picture(n, n, [](std::size_t row, std::size_t column) {
        const double coarse = std::sin(2 * std::numbers::pi * (double(row) + 0.5) / n);
        return float(0.5 + 0.25 * coarse + (column % 2 == 0 ? 0.25 : -0.25));
    });
    const Texture texture(image, true);
    for (const float u : {0.1f, 0.1f + 1.0f / 256, 0.37f})
        for (const float v : {0.2f, 0.7f}) {
            const double coarse = 0.5 - 0.25 * std::sin(2 * std::numbers::pi * v);
            EXPECT_NEAR(texture.sample({u, v}, 4).r, coarse, 2e-3);
        }
}

TEST(Texture, filtering_changes_nothing_up_to_the_width_of_a_texel) {
    const auto image = picture(5, 4, [](std::size_t row, std::size_t column) { return float(row * 5 + column); });
    for (const float u : {0.0f, 0.33f, 0.9f})
        EXPECT_EQ(Texture(image, true).sample({u, 0.4f}, 1), Texture(image).sample({u, 0.4f}, 0));
}

}  // namespace
}  // namespace hogel::shading
