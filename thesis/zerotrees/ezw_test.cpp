// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/ezw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/coding/histogram_rule.h"
#include "hogel/error.h"
#include "thesis/wavelets/transform.h"
#include "thesis/zerotrees/ezw_passes.h"
#include "thesis/zerotrees/quantise.h"
#include "thesis/zerotrees/test_waves.h"

namespace hogel::zerotrees {
namespace {

using Extents = std::vector<std::size_t>;
using Bytes = std::vector<std::uint8_t>;

// The tree of [K] fig. 4.16, breadth first below a coarse sample that is not in the figure. T_max = 64, three planes of
// T_max/8.
class Figure {
  public:
    Figure() : magnitudes_(forest, levels(), signs()) {}
    EzwSymbol symbol(const EzwContext&, std::size_t index, int plane) {
        const EzwSymbol symbol = magnitudes_.symbol(index, plane);
        constexpr const char* names[] = {"POS ", "NEG ", "ZT ", "IZ "};
        if (index > 0) passes[static_cast<std::size_t>(plane)] += names[static_cast<int>(symbol)];
        return symbol;
    }
    void refine(std::size_t index, int plane) {
        refinements[static_cast<std::size_t>(plane)] += magnitudes_.bit(index, plane) ? '1' : '0';
    }
    bool full() const { return false; }

    const Forest forest{wavelets::Pyramid(Extents{16}, {{{0}, 4}})};
    std::array<std::string, 3> passes, refinements;

  private:
    static std::vector<float> values() { return {0, 64, -42, 27, -14, 26, -30, 8, 2, -10, -35, 3, -10, -24, 7, 5}; }
    static std::vector<std::uint32_t> levels() {
        std::vector<std::uint32_t> result;
        for (float value : values()) result.push_back(Quantiser(8).level(value));
        return result;
    }
    static std::vector<bool> signs() {
        std::vector<bool> result;
        for (float value : values()) result.push_back(value < 0);
        return result;
    }
    EzwMagnitudes magnitudes_;
};

TEST(Ezw, figure_4_16_symbol_by_symbol) {
    Figure figure;
    ezw_passes(figure.forest, 3, figure);
    EXPECT_EQ(figure.passes[2], "POS NEG ZT ZT IZ NEG ZT ");      // T = 32
    EXPECT_EQ(figure.passes[1], "POS ZT POS NEG ZT ZT ZT NEG ");  // T = 16
    EXPECT_EQ(figure.passes[0], "NEG ZT ZT NEG ZT NEG ");         // T = 8
    // Refinements, which the figure does not print: whether 64, -42, -35 are in the upper half (48, 64] of (32, 64],
    // then these and 27, 26, -30, -24 in intervals of eight.
    EXPECT_EQ(figure.refinements[1], "100");
    EXPECT_EQ(figure.refinements[0], "1101110");
}

std::vector<float> picture(const wavelets::Pyramid& pyramid) { return transformed_waves(pyramid, "ai33"); }

double error(std::span<const float> a, std::span<const float> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (static_cast<double>(a[i]) - b[i]) * (static_cast<double>(a[i]) - b[i]);
    return sum;
}

TEST(Ezw, whole_streams_are_exact_to_the_last_plane) {
    for (const wavelets::Pyramid& pyramid :
         {wavelets::Pyramid::interleaved({1}), wavelets::Pyramid::interleaved({37}),
          wavelets::Pyramid::interleaved({16, 31, 9}), wavelets::Pyramid::interleaved({7, 6, 9, 8}),
          wavelets::Pyramid::separate({7, 6, 9, 8}, {{0, 1}, {2, 3}})}) {
        const std::vector<float> values = picture(pyramid);
        std::vector<float> decoded(values.size());
        ezw_decode(pyramid, ezw_encode(pyramid, values), decoded);
        const float max_value = coding::max_magnitude(values);
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_NEAR(decoded[i], values[i], max_value * 0x1p-30 + std::abs(values[i]) * 1e-7) << i;
    }
}

TEST(Ezw, any_prefix_decodes_and_more_bytes_are_better) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({15, 16, 9});
    const std::vector<float> values = picture(pyramid);
    const Bytes whole = ezw_encode(pyramid, values);
    std::vector<float> decoded(values.size());
    double before = energy(values) * 1.0001;
    for (std::size_t length = 0; length <= whole.size(); length += length < 500 ? 1 : 97) {
        ezw_decode(pyramid, std::span(whole).first(length), decoded);
        const double now = error(values, decoded);
        EXPECT_LE(now, before * 1.01)
            << length;  // the middle of a half may by chance be farther from the value than that of the whole interval
        before = now;
        // A stream encoded with this limit equals this prefix.
        if (length % 100 == 0) {
            const Bytes made = ezw_encode(pyramid, values, {length, {}});
            EXPECT_EQ(made, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
        }
    }
    EXPECT_LT(before, 1e-12 * energy(values));
}

TEST(Ezw, stops_at_the_sqnr_asked_for) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({15, 16, 9, 5});
    const std::vector<float> values = picture(pyramid);
    std::vector<float> decoded(values.size());
    for (double asked : {3.0, 10.0, 25.0, 40.0, 90.0}) {
        const Bytes bytes = ezw_encode(pyramid, values, {.sqnr = asked});
        ezw_decode(pyramid, bytes, decoded);
        const double allowed = energy(values) * std::pow(10, -asked / 10);
        EXPECT_LE(error(values, decoded), allowed);
        // Encoding stops as soon as the SQNR is reached, apart from a few final bytes.
        ASSERT_GT(bytes.size(), 10u);
        ezw_decode(pyramid, std::span(bytes).first(bytes.size() - 10), decoded);
        EXPECT_GT(error(values, decoded), allowed);
    }
}

TEST(Ezw, hostile_bytes_decode_to_finite_values_or_an_error) {
    std::mt19937 random(6);
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({9, 8, 7});
    const Bytes good = ezw_encode(pyramid, picture(pyramid), {300, {}});
    std::vector<float> decoded(pyramid.size());
    for (int trial = 0; trial < 1000; ++trial) {
        Bytes bytes = good;
        if (trial % 2 == 0)
            bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1u << random() % 8);
        else
            for (std::size_t i = 4; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(random());
        try {
            ezw_decode(pyramid, bytes, decoded);
            for (float value : decoded) ASSERT_TRUE(std::isfinite(value));
        } catch (const Error& found) {
            EXPECT_EQ(found.code(), ErrorCode::bad_input);
        }
    }
}

TEST(Ezw, zeros_and_nonsense) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({4, 4});
    std::vector<float> values(16), decoded(16, 1.0f);
    EXPECT_EQ(ezw_encode(pyramid, values).size(), 4u);
    ezw_decode(pyramid, ezw_encode(pyramid, values), decoded);
    EXPECT_EQ(decoded, values);
    values[3] = HUGE_VALF;
    EXPECT_THROW(ezw_encode(pyramid, values), Error);
    EXPECT_THROW(ezw_encode(pyramid, std::vector<float>(15)), Error);
    EXPECT_THROW(ezw_encode(pyramid, decoded, {.sqnr = -1}), Error);
}

}  // namespace
}  // namespace hogel::zerotrees
