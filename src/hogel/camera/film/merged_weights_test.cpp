// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/merged_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "hogel/camera/film/interpolation.h"
#include "hogel/core/test_targets.h"
#include "hogel/optics/lines.h"

namespace hogel::camera::film {
namespace {

using namespace optics;

HOGEL_TEST_ON_EVERY_TARGET(MergedWeightsOnTargets);

using Point = MergedWeights::Point;

Array<float, 1> noise(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    Array<float, 1> values({count});
    for (float& value : values.elements()) value = uniform(random);
    return values;
}

// Values t of sixteen lines, not in order.
std::vector<float> line_numbers() {
    std::vector<float> t;
    for (int line = 0; line < 16; ++line) t.push_back(-1 + 2.0f / 15 * static_cast<float>(line * 7 % 16));
    return t;
}

// Returns the value at a point of one of sixteen lines of `size` samples.
double value_at(const Array<float, 1>& lines, std::size_t size, std::size_t line, double t, const Point& point) {
    return std::lerp(double(point.low_factor), double(point.high_factor), 0.5 * (t + 1)) *
           smooth_at<TwelvePoint>(size, std::lerp(point.low, point.high, 0.5 * (t + 1)),
                                  [&](std::size_t i) { return lines(i * block_lines + line); });
}

// Points at the same position on all lines, at positions that differ little or as much as allowed; across a sample, in
// both directions, and some outside.
TEST_P(MergedWeightsOnTargets, are_those_of_each_line) {
    constexpr std::size_t size = 60;
    const Array<float, 1> lines = noise(size * block_lines);
    const std::vector<float> t = line_numbers();
    for (const double spread : {0.0, 0.02, 0.14, 0.5}) {
        std::vector<Point> points{
            {7.3, 7.3 + spread, 1, 1.1f}, {20.9, 20.9 + spread, -0.5f, -0.5f}, {21.95 + spread, 21.95, 0.7f, 0.7f},
            {52, 52 + spread, 1, 1},      {-400, -400 + spread, 1, 1},         {4.8 - spread, 4.8, 1, 1},
            {55, 55 + spread, 1, 1}};
        MergedWeights weights;
        ASSERT_TRUE(weights.set(points, size));
        EXPECT_GE(weights.first(), 2u);
        EXPECT_LE(weights.first() + weights.taps(), size);
        points.resize(4);  // those that are inside
        alignas(64) float fast[block_lines], plain[block_lines];
        sum_merged(lines.data(), weights, t.data(), fast);
        sum_merged_plain(lines.data(), weights, t.data(), plain);
        for (std::size_t line = 0; line < block_lines; ++line) {
            double expected = 0;
            for (const Point& point : points) expected += value_at(lines, size, line, t[line], point);
            ASSERT_NEAR(fast[line], expected, 5e-4 * static_cast<double>(points.size())) << spread << " " << line;
            ASSERT_NEAR(fast[line], plain[line], 5e-6) << spread << " " << line;
        }
    }
}

TEST_P(MergedWeightsOnTargets, vector_and_plain_weights_agree) {
    const std::vector<Point> points{{7.3, 7.6, 1, 1.1f}, {20.9, 21.3, -0.5f, -0.4f}, {8.1, 8.1, 2, 2}};
    for (std::size_t node = 0; node < 5; ++node) {
        std::vector<float> fast(60, 1), plain(60, 1);
        add_weights(points, node, 5, 2, fast.data());
        add_weights_plain(points, node, 5, 2, plain.data());
        for (std::size_t i = 0; i < 26; ++i) ASSERT_NEAR(fast[i], plain[i], 2e-6) << node << " " << i;
    }
}

TEST(MergedWeights, are_not_shared_by_lines_that_differ_too_much) {
    MergedWeights weights;
    EXPECT_FALSE(weights.set(std::vector<Point>{{20, 20.1, 1, 1}, {30, 30.51, 1, 1}}, 60));
    EXPECT_TRUE(weights.set(std::vector<Point>{{20, 20.1, 1, 1}, {30, 30.49, 1, 1}}, 60));
    EXPECT_TRUE(weights.set(std::vector<Point>{{20, 20.1, 1, 1}, {900, 930, 1, 1}}, 60));
    EXPECT_TRUE(weights.set({}, 60));
    EXPECT_EQ(weights.taps(), 0u);
    EXPECT_TRUE(weights.set(std::vector<Point>{{3, 3, 1, 1}}, 8));  // fewer samples than taps
    EXPECT_EQ(weights.taps(), 0u);
}

// Constants are preserved, and waves up to nearly the highest frequency of a film's intensities, 1/2.4 cycles per
// sample. Values are zero where a neighbour is missing.
TEST(MergedWeights, keep_waves) {
    constexpr std::size_t size = 40;
    Array<float, 1> lines({size * block_lines});
    const std::vector<float> t(block_lines, 0.0f);
    const auto value = [&](double at) {
        MergedWeights weights;
        EXPECT_TRUE(weights.set(std::vector<Point>{{at, at, 1, 1}}, size));
        alignas(64) float values[block_lines];
        sum_merged(lines.data(), weights, t.data(), values);
        return values[5];
    };
    for (const auto& [frequency, tolerance] : {std::pair{0.0, 4e-6}, {0.1, 3e-3}, {0.3, 3e-3}, {0.35, 2e-2}}) {
        const auto wave = [&](double at) { return 3 + std::cos(6.283185307179586 * frequency * at); };
        for (std::size_t i = 0; i < lines.size(); ++i)
            lines(i) = static_cast<float>(wave(static_cast<double>(i / block_lines)));
        for (const double at : {5.0, 8.25, 20.5, 33.99}) EXPECT_NEAR(value(at), wave(at), tolerance) << at;
    }
    for (const double at : {-3.0, 4.9, 34.1, 1e9}) EXPECT_EQ(value(at), 0) << at;
}

}  // namespace
}  // namespace hogel::camera::film
