// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/jpeg4d_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "thesis/zerotrees/jpeg4d.h"
#include "thesis/zerotrees/quantise.h"

namespace hogel::zerotrees {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Coefficients of blocks; each frequency has a normal distribution with its own spread.
template <class Spread>
std::vector<float> noise(const wavelets::Pyramid& pyramid, Spread&& spread) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    const std::vector<std::size_t> strides = pyramid.strides();
    std::vector<float> values(pyramid.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::size_t sum = 0;
        for (std::size_t axis = 0; axis < strides.size(); ++axis) sum += i / strides[axis] % pyramid.shape()[axis] % 8;
        values[i] = static_cast<float>(spread(sum)) * normal(random);
    }
    return values;
}

double squared_error(const wavelets::Pyramid& pyramid, const std::vector<float>& values, const Bytes& code) {
    std::vector<float> decoded(values.size());
    jpeg4d_decode(pyramid, code, decoded);
    for (std::size_t i = 0; i < values.size(); ++i) decoded[i] -= values[i];
    return energy(decoded);
}

// Bytes for an SQNR, interpolated between codes with neighbouring scales.
double bytes_at(const wavelets::Pyramid& pyramid, const std::vector<float>& values, double sqnr,
                QuantisationTable table) {
    double before = 0, before_bytes = 0;
    for (double scale = 2; scale > 1e-5; scale /= 1.3) {
        const Bytes code = jpeg4d_encode(pyramid, values, scale, table);
        const double here = 10 * std::log10(energy(values) / squared_error(pyramid, values, code));
        const auto bytes = static_cast<double>(code.size());
        if (here >= sqnr) return before_bytes + (bytes - before_bytes) * (sqnr - before) / (here - before);
        before = here;
        before_bytes = bytes;
    }
    return HUGE_VAL;
}

// Random exponents are read back for all shapes.
TEST(OwnTable, comes_back) {
    std::mt19937 random(2);
    for (const std::vector<std::size_t>& shape :
         {std::vector<std::size_t>{8, 9, 1, 17}, {3}, {5, 12}, {2, 7, 8}, {16, 8, 8, 8}}) {
        const Blocks blocks(wavelets::Pyramid::interleaved(shape));
        Exponents exponents(zigzag(shape.size()).size(), 0), read;
        for (const Frequency& frequency : blocks.frequencies())
            exponents[index_in_block(frequency)] = static_cast<std::uint8_t>(random() % (max_exponent + 1));
        coding::ArithmeticEncoder encoder;
        write_exponents(encoder, blocks, exponents);
        const Bytes code = encoder.finish();
        coding::ArithmeticDecoder decoder(code);
        ASSERT_TRUE(read_exponents(decoder, blocks, read));
        EXPECT_EQ(read, exponents);
        EXPECT_TRUE(decoder.all_read());
        const std::span<const std::uint8_t> half(code.data(), code.size() / 2);
        coding::ArithmeticDecoder cut(half);
        EXPECT_FALSE(read_exponents(cut, blocks, read));
    }
}

// The table contains exactly the frequencies of some block of the array and those below them.
TEST(OwnTable, has_the_frequencies_of_the_blocks) {
    for (const std::vector<std::size_t>& shape : {std::vector<std::size_t>{8, 9, 1, 17}, {3}, {5, 12}, {2, 7, 8}}) {
        const Blocks blocks(wavelets::Pyramid::interleaved(shape));
        std::vector<bool> listed(zigzag(shape.size()).size());
        for (const Frequency& frequency : blocks.frequencies()) listed[index_in_block(frequency)] = true;
        for (const Blocks::Kind& kind : blocks.kinds())
            for (const std::uint16_t whole : kind.full_index) EXPECT_TRUE(listed[whole]);
    }
    EXPECT_EQ(Blocks(wavelets::Pyramid::interleaved({9, 1, 16})).frequencies().size(), 64u);
    EXPECT_EQ(Blocks(wavelets::Pyramid::interleaved({4, 2})).frequencies().size(), 7u * 5u);
}

// Values decode to the nearest multiple of scale · 2^(e/4), except that values up to 0.6 steps above a multiple are
// rounded down.
TEST(OwnTable, decodes_to_multiples_of_its_steps) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({16, 24, 11});
    const std::vector<float> values = noise(pyramid, [](std::size_t sum) { return std::exp2(-0.4 * double(sum)); });
    const double scale = 0.0625;
    const Blocks blocks(pyramid);
    const Exponents exponents = choose_exponents(blocks, values, scale);
    std::vector<float> decoded(values.size());
    jpeg4d_decode(pyramid, jpeg4d_encode(pyramid, values, scale), decoded);
    std::size_t coarser = 0, entries = 0;
    for (std::size_t number = 0; number < blocks.count(); ++number) {
        const Blocks::Block block = blocks[number];
        const Blocks::Kind& kind = blocks.kind(block);
        for (std::size_t entry = 0; entry < kind.offsets.size(); ++entry, ++entries) {
            const std::uint8_t e = exponents[kind.full_index[entry]];
            const double step = scale * std::pow(2, e / 4.0);
            const double value = values[block.origin + kind.offsets[entry]];
            const double level = std::floor(std::abs(value) / step + 0.4);
            EXPECT_NEAR(decoded[block.origin + kind.offsets[entry]], std::copysign(level * step, value),
                        1e-6 * level * step);
            coarser += e > 0;
        }
    }
    EXPECT_EQ(entries, values.size());
    EXPECT_GT(coarser, 0u);
}

// For squared error a flat table is optimal if steps are fine: in theory, D'(q) = q/6 and R'(q) = -1/(q ln 2) balance
// at q = scale. If most values are below half a step, so that zeros cost nothing, coarser steps are better.
TEST(OwnTable, is_flat_for_fine_steps_and_coarser_for_coarse_ones) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({64, 64, 8});
    const std::vector<float> values = noise(pyramid, [](std::size_t) { return 1.0; });
    const Blocks blocks(pyramid);
    const auto mean = [&](double scale) {
        const Exponents exponents = choose_exponents(blocks, values, scale);
        double sum = 0;
        for (const std::uint8_t e : exponents) sum += e;
        return sum / static_cast<double>(exponents.size());
    };
    EXPECT_LT(mean(0.02), 0.5);
    EXPECT_GT(mean(3), 1.5);
}

// Even for a single block the table costs less than it saves.
TEST(OwnTable, takes_fewer_bytes_than_jpegs) {
    for (const std::vector<std::size_t>& shape : {std::vector<std::size_t>{8, 8, 8, 8}, {64, 64, 8}, {64, 64}}) {
        const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved(shape);
        const std::vector<float> values =
            noise(pyramid, [](std::size_t sum) { return std::exp2(-0.5 * static_cast<double>(sum)); });
        for (const double sqnr : {15.0, 30.0}) {
            const double own = bytes_at(pyramid, values, sqnr, QuantisationTable::own);
            EXPECT_LT(own, 0.97 * bytes_at(pyramid, values, sqnr, QuantisationTable::jpeg)) << shape.size() << sqnr;
        }
    }
}

}  // namespace
}  // namespace hogel::zerotrees
