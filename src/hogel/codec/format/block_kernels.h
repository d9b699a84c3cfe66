// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hogel::codec::format {

// The innermost loops of the coder "hogel", as SIMD code (block_kernels_simd.cpp) and as plain twins. Both give the
// same bits, because the order of the additions is part of the format.

constexpr std::size_t block_side = 8, block_samples = block_side * block_side;
using BlockSamples = std::array<float, block_samples>;

// Interpolation has six taps along each axis, two of them before the first sample of the block.
constexpr std::size_t taps = 6, taps_before = taps / 2 - 1, window_side = block_side + taps - 1;
using Taps = std::array<float, taps>;

// Interpolates a block from a window whose rows are `stride` samples apart. Along an axis with weights the window has
// window_side samples; along an axis without (null) it has block_side, which are copied.
void interpolate_block_plain(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                             BlockSamples& block);
extern decltype(interpolate_block_plain)& interpolate_block;

// out = weight_a a + weight_b b; `out` may be a or b.
void mix_blocks_plain(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b, BlockSamples& out);
extern decltype(mix_blocks_plain)& mix_blocks;

// Computes mix_blocks() and returns Σ (out − target)². `out` must be neither a nor b.
float mix_and_compare_plain(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b,
                            const BlockSamples& target, BlockSamples& out);
extern decltype(mix_and_compare_plain)& mix_and_compare;

// Returns Σ (a − b)²; the rows of a are `stride` samples apart.
float squared_difference(const float* a, std::size_t stride, const BlockSamples& b);
float squared_difference_plain(const float* a, std::size_t stride, const BlockSamples& b);
inline float squared_difference(const BlockSamples& a, const BlockSamples& b) {
    return squared_difference(a.data(), block_side, b);
}

// Returns Σ (a − b)² of rows of any length, in eight partial sums of every eighth sample.
double squared_difference_of_rows_plain(const float* a, const float* b, std::size_t count);
extern decltype(squared_difference_of_rows_plain)& squared_difference_of_rows;

// Sums Σ (a − b) slope and Σ slope² of a Gauss–Newton step.
struct AlongSlope {
    float difference, square;
    friend bool operator==(const AlongSlope&, const AlongSlope&) = default;
};
AlongSlope along_slope_plain(const BlockSamples& a, const BlockSamples& b, const BlockSamples& slope);
extern decltype(along_slope_plain)& along_slope;

// Returns one bit per sample: whether its magnitude is at least `min_magnitude`.
std::uint64_t large_samples_plain(const BlockSamples& block, float min_magnitude);
extern decltype(large_samples_plain)& large_samples;

// Returns Σ a², in partial sums as above.
double sum_of_squares_plain(const float* a, std::size_t count);
extern decltype(sum_of_squares_plain)& sum_of_squares;

// Slopes of a block along u and v, by central differences in a window of slope_window_side rows: weights of
// adjacent samples and of samples at a distance of two.
constexpr float slope_of_near = 2.0f / 3, slope_of_far = 1.0f / 12;
constexpr std::size_t slope_reach = 2, slope_window_side = block_side + 2 * slope_reach;
struct Slopes {
    BlockSamples u, v;
    friend bool operator==(const Slopes&, const Slopes&) = default;
};
void slopes_of_block_plain(const float* rows, std::size_t stride, Slopes& slopes);
extern decltype(slopes_of_block_plain)& slopes_of_block;

// Best prediction so far of the samples on one side of each partition edge.
constexpr std::size_t block_edges = 128;
using PerEdge = std::array<float, block_edges>;
struct BestPerEdge {
    PerEdge cost;
    PerEdge choice;  // index of the prediction, from the caller; a small whole number
    friend bool operator==(const BestPerEdge&, const BestPerEdge&) = default;
};
// An edge cuts each row of a block. Cut n < block_side contains the first n samples of the row; cut n >= block_side
// contains all samples with indices >= n − block_side.
constexpr std::size_t row_cuts = 2 * block_side;
constexpr bool sample_in_cut(std::size_t column, std::size_t cut) {
    return cut < block_side ? column < cut : column >= cut - block_side;
}
// [row][edge]: the samples of the second partition as a cut of the row.
using EdgeRowCuts = std::array<std::array<std::int32_t, block_edges>, block_side>;
// Stores the index `choice` of a prediction for each edge and partition for which the sum of squared differences over
// the partition, plus `extra`, is less than the stored cost. All 128 edges are evaluated from the sums of all cuts of
// the rows.
void keep_better_plain(const BlockSamples& prediction, const BlockSamples& target, float extra, float choice,
                       const EdgeRowCuts& edges, BestPerEdge& main, BestPerEdge& second);
extern decltype(keep_better_plain)& keep_better;

// in · transposed: transforms along u. `out` must not be `in`.
void transform_along_u_plain(const BlockSamples& transposed, const BlockSamples& in, BlockSamples& out);
extern decltype(transform_along_u_plain)& transform_along_u;

// matrix · in: transforms along v. `out` must not be `in`.
void transform_along_v_plain(const BlockSamples& matrix, const BlockSamples& in, BlockSamples& out);
extern decltype(transform_along_v_plain)& transform_along_v;

// matrix · in · matrixᵀ, along u first. `transposed` is matrixᵀ.
void transform_both_ways_plain(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                               BlockSamples& out);
extern decltype(transform_both_ways_plain)& transform_both_ways;

}  // namespace hogel::codec::format
