// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/jpeg4d.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "hogel/error.h"
#include "thesis/wavelets/transform.h"
#include "thesis/zerotrees/jpeg4d_blocks.h"
#include "thesis/zerotrees/quantise.h"
#include "thesis/zerotrees/test_waves.h"

namespace hogel::zerotrees {
namespace {

using Extents = std::vector<std::size_t>;
using Bytes = std::vector<std::uint8_t>;

// ISO 10918-1, figure A.6: the position of each entry of a block in the zigzag order.
TEST(Jpeg4d, zigzag_of_two_dimensions_is_jpegs) {
    constexpr int sequence[8][8] = {{0, 1, 5, 6, 14, 15, 27, 28},     {2, 4, 7, 13, 16, 26, 29, 42},
                                    {3, 8, 12, 17, 25, 30, 41, 43},   {9, 11, 18, 24, 31, 40, 44, 53},
                                    {10, 19, 23, 32, 39, 45, 52, 54}, {20, 22, 33, 38, 46, 51, 55, 60},
                                    {21, 34, 37, 47, 50, 56, 59, 61}, {35, 36, 48, 49, 57, 58, 62, 63}};
    const std::vector<Frequency> order = zigzag(2);
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(sequence[order[i][0]][order[i][1]], i);
}

TEST(Jpeg4d, zigzag_of_four_dimensions_rises_in_frequency) {
    const std::vector<Frequency> order = zigzag(4);
    ASSERT_EQ(order.size(), 4096u);
    std::vector<bool> seen(4096);
    std::size_t before = 0;
    for (const Frequency& frequency : order) {
        const std::size_t sum = std::accumulate(frequency.begin(), frequency.end(), std::size_t{0});
        EXPECT_TRUE(sum == before || sum == before + 1);
        before = sum;
        const std::size_t at = ((frequency[0] * 8 + frequency[1]) * 8 + frequency[2]) * 8 + frequency[3];
        EXPECT_FALSE(seen[at]);
        seen[at] = true;
    }
}

TEST(Jpeg4d, table_is_the_outer_product) {
    EXPECT_EQ(table_entry({0, 0}), 16);
    EXPECT_EQ(table_entry({5, 6}), 113);
    EXPECT_EQ(table_entry({7, 0}), 72);
    EXPECT_EQ(table_entry({7, 0, 5, 6}), 72 * 113);
    EXPECT_EQ(table_entry({5, 6, 3}), 113 * 16);
}

// Returns the tuples of levels in zigzag order, and the levels that follow them.
std::pair<std::vector<Tuple>, std::vector<std::int32_t>> tuples_of(const std::vector<std::int32_t>& levels) {
    SparseLevels sparse;
    sparse.clear();
    for (std::size_t place = 0; place < levels.size(); ++place)
        if (levels[place] != 0) sparse.set(place, levels[place]);
    std::pair<std::vector<Tuple>, std::vector<std::int32_t>> result;
    for_each_tuple(sparse, levels.size(), [&](const Tuple& tuple, std::int32_t level) {
        result.first.push_back(tuple);
        if (tuple.bits > 0) result.second.push_back(level);
    });
    return result;
}

TEST(Jpeg4d, tuples_count_zeros_and_bits) {
    std::vector<std::int32_t> levels(64);
    levels[0] = 5;
    levels[1] = -1;
    levels[4] = -8;
    levels[40] = 1;
    const auto [tuples, after] = tuples_of(levels);
    EXPECT_EQ(tuples, (std::vector<Tuple>{{0, 3}, {0, 1}, {2, 4}, {31, 0}, {4, 1}, {0, 0}}));
    EXPECT_EQ(after, (std::vector<std::int32_t>{5, -1, -8, 1}));
    levels.assign(40, 0);
    EXPECT_EQ(tuples_of(levels).first, (std::vector<Tuple>{{0, 0}}));
    levels[31] = 1;
    levels[39] = 2;
    EXPECT_EQ(tuples_of(levels).first,
              (std::vector<Tuple>{{31, 1}, {7, 2}}));  // the last entry is not zero: no end of block
}

std::vector<float> jpeg4d_picture(const wavelets::Pyramid& pyramid) { return transformed_waves(pyramid, "dct8"); }

std::vector<wavelets::Pyramid> jpeg4d_pyramids() {
    return {wavelets::Pyramid::interleaved({1}),
            wavelets::Pyramid::interleaved({37}),
            wavelets::Pyramid::interleaved({16, 31}),
            wavelets::Pyramid::interleaved({7, 9, 11, 8}),
            wavelets::Pyramid(Extents{9, 17, 3}, {{{2, 0}, 1}}),
            wavelets::Pyramid(Extents{5, 6}, {})};
}

// The plain twin: calls visit(offset, comparable frequency) for each entry of each block.
template <class Visit>
void for_each_entry(const wavelets::Pyramid& pyramid, Visit&& visit) {
    std::vector<std::size_t> axes;
    for (const wavelets::AxisGroup& group : pyramid.groups())
        axes.insert(axes.end(), group.axes.begin(), group.axes.end());
    std::sort(axes.begin(), axes.end());
    const std::vector<std::size_t> strides = pyramid.strides();
    for (std::size_t offset = 0; offset < pyramid.size(); ++offset) {
        Frequency frequency;
        for (const std::size_t axis : axes) {
            const std::size_t extent = pyramid.shape()[axis], at = offset / strides[axis] % extent;
            frequency.push_back(at % 8 * 8 / std::min<std::size_t>(8, extent - at / 8 * 8));
        }
        visit(offset, frequency);
    }
}

TEST(Jpeg4d, decodes_to_the_nearest_multiple_of_the_table) {
    for (const wavelets::Pyramid& pyramid : jpeg4d_pyramids())
        for (double scale : {1e-6, 1e-3, 0.02, 10.0}) {
            const std::vector<float> values = jpeg4d_picture(pyramid);
            std::vector<float> decoded(values.size(), 7.0f);
            jpeg4d_decode(pyramid, jpeg4d_encode(pyramid, values, scale, QuantisationTable::jpeg), decoded);
            for_each_entry(pyramid, [&](std::size_t offset, const Frequency& frequency) {
                const double step = static_cast<float>(scale) * table_entry(frequency);
                const double nearest = step * std::nearbyint(values[offset] / step);
                ASSERT_NEAR(decoded[offset], nearest, 1e-6 * std::abs(nearest)) << offset;
            });
        }
}

TEST(Jpeg4d, every_truncation_is_noticed_and_hostile_bytes_do_no_harm) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({9, 16, 10});
    for (const QuantisationTable table : {QuantisationTable::jpeg, QuantisationTable::own}) {
        const Bytes good = jpeg4d_encode(pyramid, jpeg4d_picture(pyramid), 0.05, table);
        ASSERT_EQ(good[4] >= 0x80, table == QuantisationTable::own);
        std::vector<float> decoded(pyramid.size());
        for (std::size_t length = 0; length < good.size(); ++length)
            EXPECT_THROW(jpeg4d_decode(pyramid, std::span(good).first(length), decoded), Error) << length;
        std::mt19937 random(3);
        for (int trial = 0; trial < 2000; ++trial) {
            Bytes bytes = good;
            if (trial % 2 == 0)
                bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1u << random() % 8);
            else
                for (std::size_t i = 5; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(random());
            try {
                jpeg4d_decode(pyramid, bytes, decoded);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::bad_input);
            }
        }
    }
}

TEST(Jpeg4d, impossible_requests_are_refused) {
    const wavelets::Pyramid pyramid = wavelets::Pyramid::interleaved({4});
    const std::vector<float> values{1, 2, 3, 4};
    for (double scale : {0.0, -1.0, 1e-300, 1e-12, std::nan(""), HUGE_VAL})
        EXPECT_THROW(jpeg4d_encode(pyramid, values, scale), Error) << scale;
    EXPECT_THROW(jpeg4d_encode(pyramid, std::vector<float>{1, 2, NAN, 4}, 1), Error);
    EXPECT_THROW(jpeg4d_encode(wavelets::Pyramid::interleaved(Extents(5, 1)), std::vector<float>{1}, 1), Error);
}

}  // namespace
}  // namespace hogel::zerotrees
