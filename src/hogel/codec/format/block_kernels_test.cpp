// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/block_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hogel/core/random.h"

namespace hogel::codec::format {
namespace {

float random_value(std::uint32_t place, std::uint32_t seed) {
    return static_cast<float>(core::philox({place, seed, 0, 0}, {3, 4})[0]) * 0x1p-31f - 1;
}

BlockSamples random_block(std::uint32_t seed) {
    BlockSamples block;
    for (std::uint32_t k = 0; k < block_samples; ++k) block[k] = random_value(k, seed);
    return block;
}

// A decoder with vectors must go on from the very samples that an encoder without had.
TEST(BlockKernels, vectors_give_the_same_bits) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        constexpr std::size_t stride = 19;
        std::vector<float> rows(window_side * stride);
        for (std::uint32_t k = 0; k < rows.size(); ++k) rows[k] = random_value(k, 100 + seed);
        Taps u, v;
        for (std::uint32_t k = 0; k < taps; ++k) {
            u[k] = random_value(k, 200 + seed);
            v[k] = random_value(k, 300 + seed);
        }
        BlockSamples fast, plain;
        for (const Taps* along_u : {static_cast<const Taps*>(nullptr), static_cast<const Taps*>(&u)})
            for (const Taps* along_v : {static_cast<const Taps*>(nullptr), static_cast<const Taps*>(&v)}) {
                interpolate_block(rows.data() + 3, stride, along_u, along_v, fast);
                interpolate_block_plain(rows.data() + 3, stride, along_u, along_v, plain);
                ASSERT_EQ(fast, plain) << (along_u != nullptr) << (along_v != nullptr);
            }
        const BlockSamples a = random_block(seed), b = random_block(1000 + seed), matrix = random_block(2000 + seed);
        EXPECT_EQ(squared_difference(rows.data(), stride, b), squared_difference_plain(rows.data(), stride, b));
        EXPECT_EQ(along_slope(a, b, matrix), along_slope_plain(a, b, matrix));
        mix_blocks(a, b, u[0], u[1], fast);
        mix_blocks_plain(a, b, u[0], u[1], plain);
        EXPECT_EQ(fast, plain);
        EXPECT_EQ(mix_and_compare(a, matrix, u[2], u[3], b, fast),
                  mix_and_compare_plain(a, matrix, u[2], u[3], b, plain));
        EXPECT_EQ(fast, plain);
        Slopes slopes, plain_slopes;
        slopes_of_block(rows.data() + 1, stride, slopes);
        slopes_of_block_plain(rows.data() + 1, stride, plain_slopes);
        EXPECT_EQ(slopes, plain_slopes);
        for (const std::size_t count : {0u, 7u, 8u, 61u}) {
            EXPECT_EQ(squared_difference_of_rows(rows.data(), &rows[64], count),
                      squared_difference_of_rows_plain(rows.data(), &rows[64], count));
            EXPECT_EQ(sum_of_squares(rows.data(), count), sum_of_squares_plain(rows.data(), count));
        }
        EXPECT_EQ(large_samples(a, 0.4f), large_samples_plain(a, 0.4f));
        transform_both_ways(matrix, b, a, fast);
        transform_both_ways_plain(matrix, b, a, plain);
        EXPECT_EQ(fast, plain);
        transform_along_u(b, a, fast);
        transform_along_u_plain(b, a, plain);
        EXPECT_EQ(fast, plain);
        transform_along_v(matrix, a, fast);
        transform_along_v_plain(matrix, a, plain);
        EXPECT_EQ(fast, plain);
        LinesInRows lines;
        for (std::uint32_t r = 0; r < block_side; ++r)
            for (std::uint32_t line = 0; line < block_lines; ++line)
                lines[r][line] = static_cast<std::int32_t>((random_value(line, 5000 * seed + r) + 1) * block_side);
        BestOfLines main, beyond;
        main.cost.fill(1e9f);
        beyond.cost.fill(1e9f);
        main.way.fill(-1);
        beyond.way.fill(-1);
        BestOfLines main_plain = main, beyond_plain = beyond;
        for (std::uint32_t way = 0; way < 5; ++way) {
            const BlockSamples prediction = random_block(3000 + 7 * seed + way);
            take_better(prediction, a, 0.1f, float(way), lines, main, beyond);
            take_better_plain(prediction, a, 0.1f, float(way), lines, main_plain, beyond_plain);
        }
        EXPECT_EQ(main, main_plain);
        EXPECT_EQ(beyond, beyond_plain);
        EXPECT_EQ(std::ranges::count(main.way, -1.0f), 0);
    }
}

TEST(BlockKernels, slopes_are_those_of_a_cubic) {
    constexpr std::size_t side = slope_window_side;
    std::vector<float> rows(side * side);
    const auto cubic = [](double x, double y) {
        return 0.01 * x * x * x - 0.2 * x * y + 0.3 * y * y + 0.02 * y * y * y;
    };
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::size_t column = k % side, row = k / side;
        rows[k] = float(cubic(double(column) - 2, double(row) - 2));
    }
    Slopes slopes;
    slopes_of_block(rows.data(), side, slopes);
    for (std::size_t k = 0; k < block_samples; ++k) {
        const std::size_t column = k % block_side, row = k / block_side;
        const double x = double(column), y = double(row);
        ASSERT_NEAR(slopes.u[k], 0.03 * x * x - 0.2 * y, 1e-4);
        ASSERT_NEAR(slopes.v[k], -0.2 * x + 0.6 * y + 0.06 * y * y, 1e-4);
    }
}

// The weights of a sample alone move the window by whole samples.
TEST(BlockKernels, interpolation_moves_the_window) {
    std::vector<float> rows(window_side * window_side);
    for (std::uint32_t k = 0; k < rows.size(); ++k) rows[k] = random_value(k, 7);
    for (std::size_t down = 0; down < taps; ++down)
        for (std::size_t right = 0; right < taps; ++right) {
            Taps u{}, v{};
            u[right] = v[down] = 1;
            BlockSamples block;
            interpolate_block(rows.data(), window_side, &u, &v, block);
            for (std::size_t r = 0; r < block_side; ++r)
                for (std::size_t c = 0; c < block_side; ++c)
                    ASSERT_EQ(block[r * block_side + c], rows[(r + down) * window_side + c + right]);
        }
}

}  // namespace
}  // namespace hogel::codec::format
