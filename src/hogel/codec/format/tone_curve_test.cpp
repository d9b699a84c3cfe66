// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/tone_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "hogel/codec/encode/histogram_tone_mapping.h"
#include "hogel/core/random.h"
#include "hogel/error.h"

namespace hogel::codec::format {
namespace {

double uniform(std::uint32_t i, std::uint32_t key) { return core::philox({i, 0, 0, 0}, {key, 9})[0] * 0x1p-32; }

// Luminances over some decades: even in the logarithm, in two clusters, nearly all in one bin, over 70 decades, two
// only.
std::vector<LuminanceHistogram> histograms() {
    std::vector<LuminanceHistogram> all(5);
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const double x = uniform(i, 1);
        all[0].add(static_cast<float>(std::pow(10, 5 * x)));
        all[1].add(static_cast<float>(std::pow(10, (i % 3 ? 0.01 : 3.7) + 0.5 * x)));
        all[2].add(i % 1000 ? 3.0f : static_cast<float>(std::pow(10, 8 * x - 4)));
        all[3].add(static_cast<float>((i % 2 ? 1 : -1) * std::pow(10, 70 * x - 36)));
    }
    all[4].add(1e-3f);
    all[4].add(1e3f);
    return all;
}

// Returns the logarithmic slopes from point to point.
std::vector<double> slopes(const ToneCurve& curve) {
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < curve.values().size(); ++i)
        result.push_back(std::log(double(curve.values()[i + 1]) / curve.values()[i]) /
                         std::log(double(curve.point(i + 1)) / curve.point(i)));
    return result;
}

TEST(ToneCurve, spans_the_decades_asked_for_and_is_nowhere_steeper_than_luminance) {
    for (const LuminanceHistogram& histogram : histograms())
        for (const double decades : {0.1, 0.5, 2.0, 3.0}) {
            const std::optional<ToneCurve> curve = encode::tone_curve_of(histogram, decades);
            ASSERT_TRUE(curve);
            EXPECT_NEAR(curve->mapped_decades(), decades, 1e-6);
            EXPECT_EQ(curve->values().back(), curve->point(curve->values().size() - 1));
            EXPECT_LE(curve->decades(), 6.03);
            for (const double slope : slopes(*curve)) {
                EXPECT_GT(slope, 0);
                EXPECT_LE(slope, 1 + 1e-5);
            }
        }
}

// The exponent of the power is the ratio of the decades.
TEST(ToneCurve, is_a_power_for_luminances_even_in_the_logarithm) {
    LuminanceHistogram histogram;
    for (int i = 0; i < 400000; ++i) histogram.add(static_cast<float>(std::exp2(12 * (i + 0.5) / 400000)));
    const ToneCurve curve = encode::tone_curve_of(histogram, 1.5).value();
    for (const double slope : slopes(curve)) EXPECT_NEAR(slope, 1.5 / std::log10(4096), 1e-3);
}

// Two clusters of luminances far apart keep their contrast; the range between them gives up all of it.
TEST(ToneCurve, takes_contrast_from_empty_ranges) {
    const ToneCurve curve = encode::tone_curve_of(histograms()[1], 1.8).value();
    for (std::size_t i = 0; i < slopes(curve).size(); ++i) {
        const double decade = std::log10(curve.point(i));
        if ((decade > 0.1 && decade < 0.4) || (decade > 3.8 && decade < 4.1)) {
            EXPECT_GT(slopes(curve)[i], 0.99);
        }
        if (decade > 0.7 && decade < 3.5) {
            EXPECT_LT(slopes(curve)[i], 0.4);
        }
    }
}

TEST(ToneCurve, does_not_exist_for_luminances_that_span_no_more) {
    LuminanceHistogram histogram;
    EXPECT_FALSE(encode::tone_curve_of(histogram, 2));
    for (const float value : {0.0f, 1e-42f, std::numeric_limits<float>::infinity(), std::nanf("")})
        histogram.add(value);
    EXPECT_FALSE(encode::tone_curve_of(histogram, 2));
    for (int i = 0; i < 1000; ++i) histogram.add(1 + static_cast<float>(i) * 0.02f);
    EXPECT_FALSE(encode::tone_curve_of(histogram, 2));
    EXPECT_TRUE(encode::tone_curve_of(histogram, 1.2));
}

// Exact except for rounding, which a slope s multiplies by 1/s. Mapped values keep their order.
TEST(ToneCurve, is_inverted) {
    for (const LuminanceHistogram& histogram : histograms())
        for (const double decades : {0.3, 2.0}) {
            const ToneCurve curve = encode::tone_curve_of(histogram, decades).value();
            const std::vector<double> slope = slopes(curve);
            const double max_error = 1e-6 / *std::ranges::min_element(slope);
            std::vector<float> values{0.0f, 1e-38f, 1e-44f, 1e30f};
            for (std::uint32_t i = 0; i < 2000; ++i)
                values.push_back(static_cast<float>(curve.point(0) * std::pow(10, 8 * uniform(i, 2) - 1)));
            for (std::size_t i = 0; i < curve.values().size(); ++i) values.push_back(curve.point(i));
            std::ranges::sort(values);
            float before = -1;
            for (const float value : values) {
                const float mapped = value * curve.factor(value);
                EXPECT_GE(mapped, before * (1 - 1e-6f));
                before = mapped;
                EXPECT_EQ(-value * curve.factor(-value), -mapped);
                if (value < 1e-37f) continue;  // subnormal numbers have fewer digits
                EXPECT_NEAR(mapped * curve.inverse_factor(mapped), value, max_error * value);
            }
        }
}

TEST(ToneCurve, impossible_ones_are_refused) {
    const auto refused = [](std::uint32_t first, std::vector<float> values) {
        try {
            ToneCurve(first, std::move(values));
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return true;
        }
        return false;
    };
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f) >> ToneCurve::low_bits;
    EXPECT_FALSE(refused(one, {1, 1.1f, 1.2f}));
    for (const float bad : {0.5f, 1.0f, 1.2f, -1.0f, 0.0f, nan, infinity, 1e30f, 1e-40f})
        EXPECT_TRUE(refused(one, {1, bad, 1.2f})) << bad;
    EXPECT_TRUE(refused(one, {}));
    EXPECT_TRUE(refused(one, {1}));
    EXPECT_TRUE(refused(0, {1e-30f, 2e-30f}));
    EXPECT_TRUE(refused(7, {1e-30f, 2e-30f}));
    EXPECT_TRUE(refused(2039, {1e38f, 2e38f}));
    EXPECT_TRUE(refused(~std::uint32_t{0}, {1, 2}));
    std::vector<float> many(ToneCurve::max_points + 1);
    std::iota(many.begin(), many.end(), 1.0f);
    EXPECT_TRUE(refused(one, many));
}

}  // namespace
}  // namespace hogel::codec::format
