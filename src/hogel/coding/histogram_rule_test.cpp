// SPDX-License-Identifier: Apache-2.0
#include "hogel/coding/histogram_rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hogel/error.h"

namespace hogel::coding {
namespace {

MagnitudeHistogram histogram_of(const std::vector<float>& values) {
    MagnitudeHistogram histogram;
    histogram.add(values);
    return histogram;
}

// The sum of [K] 4.4.2 over p_n = ⌊log2(T_max/|x|)⌋, for the values of fig. 4.17 without 8, which is T_max divided by a
// power of two.
TEST(HistogramRule, is_the_sum_of_the_thesis) {
    const std::vector<float> figure{64, -42, 27, -14, 26, -30, 2.5, -10, -35, 3, -10, -24, 7, 5};
    for (const double c : {0.0, 1.5, 4.8})
        for (int planes = 1; planes <= 5; ++planes) {
            double expected = 0;
            for (const float value : figure) {
                const int p = static_cast<int>(std::floor(std::log2(64 / std::abs(value))));
                if (p < planes) expected += planes - p + c;
            }
            // T_max itself closes the interval of its octave; the histogram counts it in the next.
            EXPECT_NEAR(histogram_of(figure).bits(std::ldexp(64, -planes), c), expected + 1, 1e-9) << planes;
        }
}

std::vector<float> spread_values() {
    std::vector<float> values;
    for (int i = 0; i < 4000; ++i) values.push_back(static_cast<float>(std::exp2(-i / 400.0) * (i % 2 ? 1 : -1)));
    return values;
}

TEST(HistogramRule, steps_meet_their_bits) {
    const MagnitudeHistogram histogram = histogram_of(spread_values());
    for (const double c : {0.0, 2.0, 5.0})
        for (const double bits : {500.0, 5000.0, 30000.0}) {
            // The smallest step within the number of bits, to one bin.
            EXPECT_LE(histogram.bits(histogram.step(bits, c), c), bits);
            EXPECT_GE(histogram.bits(histogram.step(bits, c) / 1.04, c), bits);
            // Whole bit planes: no power of two of the largest magnitude is nearer.
            const double step = histogram.step_of_planes(bits, c);
            EXPECT_EQ(std::log2(histogram.max() / step), std::round(std::log2(histogram.max() / step)));
            const auto miss = [&](double of) { return std::abs(std::log(histogram.bits(of, c) / bits)); };
            EXPECT_LE(miss(step), miss(step / 2));
            EXPECT_LE(miss(step), miss(step * 2));
        }
}

TEST(HistogramRule, a_larger_overhead_gives_a_larger_step) {
    const MagnitudeHistogram histogram = histogram_of(spread_values());
    EXPECT_LT(histogram.step(5000, 1), histogram.step(5000, 3));
    EXPECT_LE(histogram.step_of_planes(5000, 0), histogram.step_of_planes(5000, 9));
}

TEST(HistogramRule, histograms_of_parts_add_up) {
    const std::vector<float> values = spread_values();
    MagnitudeHistogram parts;
    parts.add(std::span(values).first(100));
    parts.add(histogram_of({values.begin() + 100, values.end()}));
    EXPECT_EQ(parts.max(), histogram_of(values).max());
    for (const double step : {0.5, 0.01, 0.001}) EXPECT_EQ(parts.bits(step, 2), histogram_of(values).bits(step, 2));
}

TEST(HistogramRule, zeros_and_impossible_values) {
    EXPECT_EQ(histogram_of({0, 0}).step(100, 3), 1);
    EXPECT_EQ(histogram_of({0, 0}).step_of_planes(100, 3), 1);
    EXPECT_THROW(histogram_of({1, NAN}), Error);
}

}  // namespace
}  // namespace hogel::coding
