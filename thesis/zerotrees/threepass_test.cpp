// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/threepass.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "hogel/coding/histogram_rule.h"
#include "hogel/error.h"
#include "thesis/wavelets/transform.h"
#include "thesis/zerotrees/test_waves.h"
#include "thesis/zerotrees/three_pass_trees.h"

namespace hogel::zerotrees {
namespace {

using Extents = std::vector<std::size_t>;
using Bytes = std::vector<std::uint8_t>;

// The tree of [K] fig. 4.17, breadth first, with the children of −14 in the order in which fig. 4.16 codes them. The
// coarse sample above it, which is not in the figure, is 0.
const std::vector<float> figure{0, 64, -42, 27, -14, 26, -30, 8, 2, -10, -35, 3, -10, -24, 7, 5};
const Forest figure_forest{wavelets::Pyramid(Extents{16}, {{{0}, 4}})};

TEST(ThreePass, figure_4_17_a_the_largest_in_each_subtree) {
    // p_t as printed, for b_max = 6: T_min = 1.
    const std::vector<int> p_t{0, 0, 0, 1, 2, 0, 1, 3, 5, 2, 0, 4, 2, 1, 3, 3};
    const std::vector<std::uint8_t> bits = subtree_bits(figure_forest, figure, Quantiser(1));
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(6 - bits[i], p_t[i]) << figure[i];
}

struct Recorder {
    std::vector<std::string> symbols;  // "Δp_t", "Δp_t,Δp_n" as in the figure
    std::vector<std::uint32_t> levels;
    void tree(int symbol, int, bool) { symbols.push_back(std::to_string(symbol)); }
    void node(int symbol, int) { symbols.back().append(",").append(std::to_string(symbol)); }
    void magnitude(std::uint32_t level, int, bool negative) {
        levels.push_back(level);
        symbols.back() += negative ? "-" : "+";
    }
};

TEST(ThreePass, figure_4_17_c_symbol_by_symbol) {
    Recorder recorder;
    write_three_pass(figure_forest, figure, Quantiser(8), 3, recorder);
    const std::vector<std::string> expected{"0,-1",                                     // the coarse sample
                                            "0,0+",                                     // 64
                                            "0,0-", "1,0+",                             // -42 27
                                            "2,0-", "0,1+", "0,0-", "-1",               // -14 26 -30 8
                                            "-1",   "0-",   "0-",   "-1", "1-", "0-"};  // 2 -10 -35 3 -10 -24
    EXPECT_EQ(recorder.symbols, expected);
    EXPECT_EQ(recorder.levels, (std::vector<std::uint32_t>{7, 5, 3, 1, 3, 3, 1, 4, 1, 2}));
}

std::vector<float> three_pass_picture(const wavelets::Pyramid& pyramid) { return transformed_waves(pyramid, "cdf97"); }

double sqnr(std::span<const float> a, std::span<const float> b) {
    double signal = 0, noise = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        signal += static_cast<double>(a[i]) * a[i];
        noise += (static_cast<double>(a[i]) - b[i]) * (static_cast<double>(a[i]) - b[i]);
    }
    return 10 * std::log10(signal / noise);
}

std::vector<wavelets::Pyramid> three_pass_pyramids() {
    return {wavelets::Pyramid::interleaved({1}),          wavelets::Pyramid::interleaved({37}),
            wavelets::Pyramid::interleaved({13, 1}),      wavelets::Pyramid::interleaved({16, 31, 9}),
            wavelets::Pyramid::interleaved({7, 6, 9, 8}), wavelets::Pyramid::separate({7, 6, 9, 8}, {{0, 1}, {2, 3}}),
            wavelets::Pyramid(Extents{20, 20}, {})};
}

// Counts the bits of each part of the code in [K] 4.4.2.
struct Alphabet {
    std::vector<int> tree, node;
    int signs = 0, bits = 0;
    std::vector<std::size_t> counts(const std::vector<int>& symbols, int planes) const {
        std::vector<std::size_t> result(static_cast<std::size_t>(planes) + 1);
        for (int symbol : symbols) ++result[static_cast<std::size_t>(++symbol)];
        return result;
    }
};

// Returns the entropy of symbols, bits.
double entropy(const std::vector<std::size_t>& counts) {
    double all = 0, sum = 0;
    for (const std::size_t count : counts) all += static_cast<double>(count);
    for (const std::size_t count : counts)
        if (count > 0) sum -= static_cast<double>(count) * std::log2(static_cast<double>(count) / all);
    return sum;
}

struct Counter {
    Alphabet& all;
    void tree(int symbol, int, bool) const { all.tree.push_back(symbol); }
    void node(int symbol, int) const { all.node.push_back(symbol); }
    void magnitude(std::uint32_t, int bits, bool) const { ++all.signs, all.bits += bits - 1; }
};

// With the frequencies of all symbols known, an ideal coder would need the entropy of Δp_t and Δp_n, a bit for each
// sign and b_max − p_n − 1 for each magnitude. Adaptive models approach that, and gain where the frequencies drift.
TEST(ThreePass, alphabets_take_the_entropy_of_the_symbols) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({40, 50, 30});
    const std::vector<float> values = three_pass_picture(pyramid);
    for (const double step : {0.001, 0.01, 0.1}) {
        const Quantiser quantiser(static_cast<float>(step));
        const int planes = std::bit_width(quantiser.level(coding::max_magnitude(values)));
        Alphabet all;
        Counter counter{all};
        write_three_pass(Forest(pyramid), values, quantiser, planes, counter);
        const double expected =
            entropy(all.counts(all.tree, planes)) + entropy(all.counts(all.node, planes)) + all.signs + all.bits;
        const Bytes bytes = three_pass_encode(pyramid, values, step, ThreePassSymbols::alphabets);
        EXPECT_LE(8.0 * static_cast<double>(bytes.size()), 1.03 * expected) << step;
        EXPECT_GE(8.0 * static_cast<double>(bytes.size()), 0.8 * expected) << step;
    }
}

TEST(ThreePass, decodes_to_the_middles_of_the_levels) {
    for (const wavelets::Pyramid& pyramid : three_pass_pyramids())
        for (double step : {0.001, 0.1, 1.0, 100.0}) {
            const std::vector<float> values = three_pass_picture(pyramid);
            const Bytes bytes = three_pass_encode(pyramid, values, step);
            std::vector<float> decoded(values.size(), 7.0f);
            three_pass_decode(pyramid, bytes, decoded);
            const Quantiser quantiser(static_cast<float>(step));
            for (std::size_t i = 0; i < values.size(); ++i)
                ASSERT_EQ(decoded[i], quantiser.value(quantiser.level(values[i]), values[i] < 0)) << i << " " << step;
            // [K]'s alphabets hold the same levels.
            std::vector<float> with_alphabets(values.size(), 7.0f);
            three_pass_decode(pyramid, three_pass_encode(pyramid, values, step, ThreePassSymbols::alphabets),
                              with_alphabets);
            ASSERT_EQ(with_alphabets, decoded) << step;
            std::vector<float> rounded = values;
            three_pass_round(bytes, rounded);
            EXPECT_EQ(std::memcmp(rounded.data(), decoded.data(), values.size() * sizeof(float)), 0) << step;
        }
}

TEST(ThreePass, zeros_take_next_to_nothing) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({64, 64});
    const std::vector<float> zeros(pyramid.size());
    const Bytes bytes = three_pass_encode(pyramid, zeros, 1);
    EXPECT_LE(bytes.size(), 6u);
    std::vector<float> decoded(zeros.size(), 1.0f);
    three_pass_decode(pyramid, bytes, decoded);
    EXPECT_EQ(decoded, zeros);
}

TEST(ThreePass, every_truncation_is_noticed) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({9, 8, 7});
    for (const ThreePassSymbols symbols : {ThreePassSymbols::bits, ThreePassSymbols::alphabets}) {
        const Bytes bytes = three_pass_encode(pyramid, three_pass_picture(pyramid), 0.05, symbols);
        std::vector<float> decoded(pyramid.size());
        three_pass_decode(pyramid, bytes, decoded);
        for (std::size_t length = 0; length < bytes.size(); ++length)
            EXPECT_THROW(three_pass_decode(pyramid, std::span(bytes).first(length), decoded), Error) << length;
    }
}

TEST(ThreePass, hostile_bytes_end_in_an_error_or_in_finite_values) {
    std::mt19937 random(3);
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({9, 8, 7});
    const Bytes with_bits = three_pass_encode(pyramid, three_pass_picture(pyramid), 0.05);
    const Bytes with_alphabets =
        three_pass_encode(pyramid, three_pass_picture(pyramid), 0.05, ThreePassSymbols::alphabets);
    std::vector<float> decoded(pyramid.size());
    for (int trial = 0; trial < 6000; ++trial) {
        Bytes bytes = trial < 3000 ? with_bits : with_alphabets;
        if (trial % 2 == 0)
            bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1u << random() % 8);
        else
            for (std::size_t i = 5; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(random());
        try {
            three_pass_decode(pyramid, bytes, decoded);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
        }
    }
}

TEST(ThreePass, meets_the_sqnr_asked_for) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({40, 50, 30});
    const std::vector<float> values = three_pass_picture(pyramid);
    std::vector<float> decoded(values.size());
    for (double asked : {5.0, 20.0, 40.0, 80.0, 110.0}) {
        three_pass_decode(pyramid, three_pass_encode(pyramid, values, step_for_sqnr(values, asked)), decoded);
        EXPECT_GE(sqnr(values, decoded), asked - 0.001);
        EXPECT_LE(sqnr(values, decoded), asked + 0.1);
    }
}

TEST(ThreePass, impossible_requests_are_refused) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({4});
    const std::vector<float> values{1, 2, 3, 4};
    for (double step : {0.0, -1.0, 1e-300, 1e-12, std::nan(""), HUGE_VAL})
        EXPECT_THROW(three_pass_encode(pyramid, values, step), Error) << step;
    EXPECT_THROW(three_pass_encode(pyramid, std::vector<float>{1, 2, NAN, 4}, 1), Error);
    EXPECT_THROW(three_pass_encode(pyramid, std::vector<float>{1, 2, 3}, 1), Error);
    for (double asked : {0.0, -3.0, 500.0, std::nan("")}) EXPECT_THROW(step_for_sqnr(values, asked), Error);
}

// A single coding yields approximately the requested size.
TEST(HistogramRule, predicts_the_size_of_three_pass_codes) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({40, 50, 30});
    std::vector<float> values(pyramid.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] =
            static_cast<float>(std::sin(0.11 * static_cast<double>(i / 1500) + 0.18 * static_cast<double>(i / 30 % 50) +
                                        0.25 * static_cast<double>(i % 30)) +
                               (i / 1500 + i % 30 > i / 30 % 50 + 3 ? 0.5 : 0));
    wavelets::transform("cdf97").forward(pyramid, values);
    coding::MagnitudeHistogram histogram;
    histogram.add(values);
    for (const double bits_each : {0.05, 0.3, 1.0, 4.0}) {
        const double bits = bits_each * static_cast<double>(values.size());
        const auto code = three_pass_encode(pyramid, values, histogram.step(bits, 4.8));
        EXPECT_NEAR(8.0 * static_cast<double>(code.size()) / bits, 1, 0.2) << bits_each;
    }
}

}  // namespace
}  // namespace hogel::zerotrees
