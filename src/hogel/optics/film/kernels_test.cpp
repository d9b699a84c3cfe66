// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/film/kernels.h"
#include "hogel/optics/film/resample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
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

// Widths around every multiple of a vector; points inside, at both ends and outside; columns that differ much from
// each other, little, and not at all.
TEST_P(FilmKernels, vector_and_plain_columns_agree) {
    const std::size_t height = 40, stride = 150;
    const std::vector<float> values = noise(height * stride);
    for (const double bend : {0.3, 0.01, 0.0}) {
        std::vector<double> slopes(stride);
        for (std::size_t i = 0; i < stride; ++i) slopes[i] = std::cos(bend * (static_cast<double>(i) - 40));
        for (const std::vector<double>& scales :
             {std::vector<double>{12.3}, {-7, -6.6, -3.1, 0.0, 0.25, 3}, {-11, -4, 1, 2, 3, 4, 5, 23.7, 40}})
            for (std::size_t width = 0; width <= stride; width += width < 40 ? 1 : 11) {
                std::vector<float> fast(width, 1), plain(width, 1);
                const ColumnPoints points{std::span(slopes).first(width), scales, 9.7};
                sum_down_columns(values.data(), stride, height, points, fast);
                sum_down_columns_plain(values.data(), stride, height, points, plain);
                const double allowed = 5e-4 * static_cast<double>(scales.size());
                for (std::size_t x = 0; x < width; ++x)
                    ASSERT_NEAR(fast[x], plain[x], allowed) << bend << " " << width << " " << x;
            }
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

// Constants are kept, and waves up to nearly the highest frequency of a film's intensities, 1/2.4 cycles a sample;
// where a neighbour is missing, values are zero.
TEST_P(FilmKernels, keep_waves) {
    std::vector<float> line(40);
    for (const auto& [frequency, tolerance] : {std::pair{0.0, 4e-6}, {0.1, 3e-3}, {0.3, 3e-3}, {0.35, 2e-2}}) {
        const auto wave = [&](double at) { return 3 + std::cos(6.283185307179586 * frequency * at); };
        for (std::size_t i = 0; i < line.size(); ++i) line[i] = static_cast<float>(wave(static_cast<double>(i)));
        for (double at : {5.0, 8.25, 20.5, 33.99}) {
            std::vector<float> value(1);
            add_along_line(line, {0, 0, 1, 1, at}, 1, value);  // d = 0: at the offset itself, r = 1
            EXPECT_NEAR(value[0], wave(at), tolerance) << at;
            std::vector<float> down(1);
            const double slope = 1, scale = at - 2;
            sum_down_columns(line.data(), 1, line.size(), {std::span(&slope, 1), std::span(&scale, 1), 2}, down);
            EXPECT_NEAR(down[0], wave(at), tolerance) << at;
        }
    }
    for (double at : {-3.0, 4.9, 34.1, 1e9}) {
        std::vector<float> value(1);
        add_along_line(line, {0, 0, 1, 1, at}, 1, value);
        EXPECT_EQ(value[0], 0) << at;
    }
}

// Waves are kept up to the highest frequency that is passed: their images are stopped.
TEST_P(FilmKernels, resampling_keeps_what_it_passes) {
    const InterpolationTable table;
    for (const double frequency : {0.0, 0.1, 0.25, InterpolationTable::pass}) {
        const auto wave = [&](double at) {
            return std::polar(1.0f, static_cast<float>(6.283185307179586 * frequency * at));
        };
        std::vector<std::complex<float>> line;
        for (int i = 0; i < 60; ++i) line.push_back(wave(i));
        const std::size_t count = 300;
        std::vector<std::complex<float>> values(count);
        // Places 20 … 40, nearly uniform.
        const TangentPlaces places{-0.01, 0.02 / static_cast<double>(count), 1, 1000, 30};
        resample_tangents(line, places, table, values);
        for (std::size_t i = 0; i < count; ++i) {
            const double s = places.first + static_cast<double>(i) * places.step;
            EXPECT_LT(std::abs(values[i] - wave(30 + 1000 * s / std::sqrt(1 - s * s))), 1.2e-3f) << frequency;
        }
    }
}

// Positions inside, at both ends and outside, going forwards and backwards.
TEST_P(FilmKernels, vector_and_plain_resampling_agree) {
    const InterpolationTable table;
    std::vector<std::complex<float>> line;
    for (float value : noise(90)) line.emplace_back(value, 0.3f - value * value);
    for (const double scale : {55.0, -70.0})
        for (std::size_t count = 0; count <= 150; ++count) {
            const TangentPlaces places{-0.8, 1.6 / static_cast<double>(count + 1), 1.2, scale, 44.3};
            std::vector<std::complex<float>> fast(count), plain(count);
            resample_tangents(line, places, table, fast);
            resample_tangents_plain(line, places, table, plain);
            for (std::size_t i = 0; i < count; ++i) EXPECT_LT(std::abs(fast[i] - plain[i]), 1e-5f) << count << ' ' << i;
        }
}

}  // namespace
}  // namespace hogel::optics::film
