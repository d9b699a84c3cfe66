// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/film/kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "hogel/core/test_targets.h"

namespace hogel::optics::film {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(FilmKernels);

std::vector<float> noise(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<float> values(count);
    for (float& value : values) value = uniform(random);
    return values;
}

// Widths around every multiple of a vector; positions inside, at both ends and outside.
TEST_P(FilmKernels, vector_and_plain_columns_agree) {
    const std::size_t height = 20, stride = 50;
    const std::vector<float> values = noise(height * stride);
    std::vector<double> slopes(stride);
    for (std::size_t i = 0; i < stride; ++i) slopes[i] = std::cos(0.3 * static_cast<double>(i));
    for (std::size_t width = 0; width <= stride; ++width) {
        std::vector<float> fast(width, 1), plain(width, 1);
        const ColumnPlaces places{std::span(slopes).first(width), 12.3, 9.7};
        add_down_columns(values.data(), stride, height, places, 0.7f, fast);
        add_down_columns_plain(values.data(), stride, height, places, 0.7f, plain);
        for (std::size_t x = 0; x < width; ++x) EXPECT_NEAR(fast[x], plain[x], 1e-5f) << width << " " << x;
    }
}

TEST_P(FilmKernels, vector_and_plain_lines_agree) {
    const std::vector<float> line = noise(200);
    for (std::size_t width = 0; width <= 70; ++width) {
        std::vector<float> fast(width, 1), plain(width, 1);
        const LinePlaces places{-0.3, 0.02, 1.1, 150, 40};
        add_along_line(line, places, 0.7f, fast);
        add_along_line_plain(line, places, 0.7f, plain);
        for (std::size_t x = 0; x < width; ++x) EXPECT_NEAR(fast[x], plain[x], 1e-5f) << width << " " << x;
    }
}

// Cubic interpolation reproduces parabolas exactly, except outside, where values are zero.
TEST_P(FilmKernels, keep_parabolas) {
    std::vector<float> line(40);
    for (std::size_t i = 0; i < line.size(); ++i) line[i] = 3 + 0.01f * static_cast<float>(i * i);
    for (double at : {1.0, 5.25, 20.5, 36.99}) {
        std::vector<float> value(1);
        add_along_line(line, {0, 0, 1, 1, at}, 1, value);  // d = 0: at the offset itself, r = 1
        EXPECT_NEAR(value[0], 3 + 0.01 * at * at, 1e-4) << at;
        std::vector<float> down(1);
        const double slope = 1;
        add_down_columns(line.data(), 1, line.size(), {std::span(&slope, 1), at - 2, 2}, 1, down);
        EXPECT_NEAR(down[0], 3 + 0.01 * at * at, 1e-4) << at;
    }
    for (double at : {-3.0, 0.5, 38.5, 1e9}) {
        std::vector<float> value(1);
        add_along_line(line, {0, 0, 1, 1, at}, 1, value);
        EXPECT_EQ(value[0], 0) << at;
    }
}

}  // namespace
}  // namespace hogel::optics::film
