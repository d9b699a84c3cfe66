// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/block_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hogel/core/random.h"
#include "hogel/core/test_targets.h"

namespace hogel::codec::format {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(BlockKernels);

float random_value(std::uint32_t place, std::uint32_t seed) {
    return static_cast<float>(core::philox({place, seed, 0, 0}, {3, 4})[0]) * 0x1p-31f - 1;
}

BlockSamples random_block(std::uint32_t seed) {
    BlockSamples block;
    for (std::uint32_t k = 0; k < block_samples; ++k) block[k] = random_value(k, seed);
    return block;
}

// Random rows, weights and blocks.
struct Inputs {
    static constexpr std::size_t stride = 19;
    std::vector<float> rows = std::vector<float>(window_side * stride);
    Taps u, v;
    BlockSamples a, b, matrix;

    explicit Inputs(std::uint32_t seed)
        : a(random_block(seed)), b(random_block(1000 + seed)), matrix(random_block(2000 + seed)) {
        for (std::uint32_t k = 0; k < rows.size(); ++k) rows[k] = random_value(k, 100 + seed);
        for (std::uint32_t k = 0; k < taps; ++k) {
            u[k] = random_value(k, 200 + seed);
            v[k] = random_value(k, 300 + seed);
        }
    }
};

// Vector twins and plain functions must give the same bits: encoder and decoder may run on different machines, and a
// decoder continues from reconstructed samples.
constexpr std::uint32_t seeds = 20;

TEST_P(BlockKernels, interpolation_and_mixing_twins_agree) {
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        const Inputs in(seed);
        BlockSamples fast, plain;
        for (const Taps* along_u : {static_cast<const Taps*>(nullptr), &in.u})
            for (const Taps* along_v : {static_cast<const Taps*>(nullptr), &in.v}) {
                interpolate_block(in.rows.data() + 3, in.stride, along_u, along_v, fast);
                interpolate_block_plain(in.rows.data() + 3, in.stride, along_u, along_v, plain);
                ASSERT_EQ(fast, plain) << (along_u != nullptr) << (along_v != nullptr);
            }
        mix_blocks(in.a, in.b, in.u[0], in.u[1], fast);
        mix_blocks_plain(in.a, in.b, in.u[0], in.u[1], plain);
        EXPECT_EQ(fast, plain);
        EXPECT_EQ(mix_and_compare(in.a, in.matrix, in.u[2], in.u[3], in.b, fast),
                  mix_and_compare_plain(in.a, in.matrix, in.u[2], in.u[3], in.b, plain));
        EXPECT_EQ(fast, plain);
    }
}

TEST_P(BlockKernels, twins_of_sums_and_slopes_agree) {
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        const Inputs in(seed);
        const float* rows = in.rows.data();
        EXPECT_EQ(squared_difference(rows, in.stride, in.b), squared_difference_plain(rows, in.stride, in.b));
        EXPECT_EQ(along_slope(in.a, in.b, in.matrix), along_slope_plain(in.a, in.b, in.matrix));
        EXPECT_EQ(large_samples(in.a, 0.4f), large_samples_plain(in.a, 0.4f));
        Slopes slopes, plain_slopes;
        slopes_of_block(rows + 1, in.stride, slopes);
        slopes_of_block_plain(rows + 1, in.stride, plain_slopes);
        EXPECT_EQ(slopes, plain_slopes);
        for (const std::size_t count : {0u, 7u, 8u, 61u}) {
            EXPECT_EQ(squared_difference_of_rows(rows, rows + 64, count),
                      squared_difference_of_rows_plain(rows, rows + 64, count));
            EXPECT_EQ(sum_of_squares(rows, count), sum_of_squares_plain(rows, count));
        }
    }
}

TEST_P(BlockKernels, transform_twins_agree) {
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        const Inputs in(seed);
        BlockSamples fast, plain;
        transform_both_ways(in.matrix, in.b, in.a, fast);
        transform_both_ways_plain(in.matrix, in.b, in.a, plain);
        EXPECT_EQ(fast, plain);
        transform_along_u(in.b, in.a, fast);
        transform_along_u_plain(in.b, in.a, plain);
        EXPECT_EQ(fast, plain);
        transform_along_v(in.matrix, in.a, fast);
        transform_along_v_plain(in.matrix, in.a, plain);
        EXPECT_EQ(fast, plain);
    }
}

TEST_P(BlockKernels, partition_twins_agree) {
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        const Inputs in(seed);
        EdgeRowCuts edges;
        for (std::uint32_t r = 0; r < block_side; ++r)
            for (std::uint32_t edge = 0; edge < block_edges; ++edge)
                edges[r][edge] = static_cast<std::int32_t>((random_value(edge, 5000 * seed + r) + 1) * block_side);
        BestPerEdge main, second;
        main.cost.fill(1e9f);
        second.cost.fill(1e9f);
        main.choice.fill(-1);
        second.choice.fill(-1);
        BestPerEdge main_plain = main, second_plain = second;
        for (std::uint32_t n = 0; n < 5; ++n) {
            const BlockSamples prediction = random_block(3000 + 7 * seed + n);
            keep_better(prediction, in.a, 0.1f, float(n), edges, main, second);
            keep_better_plain(prediction, in.a, 0.1f, float(n), edges, main_plain, second_plain);
        }
        EXPECT_EQ(main, main_plain);
        EXPECT_EQ(second, second_plain);
        EXPECT_EQ(std::ranges::count(main.choice, -1.0f), 0);
    }
}

TEST_P(BlockKernels, slopes_are_those_of_a_cubic) {
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

// A single weight of 1 shifts the window by whole samples.
TEST_P(BlockKernels, interpolation_with_one_weight_shifts) {
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
