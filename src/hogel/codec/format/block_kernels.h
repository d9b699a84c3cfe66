// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hogel::codec::format {

// The innermost loops of the coder "hogel": on a vector of samples where the machine has one, and plain. Both give the
// same bits, because what is added to what in which order is part of the format.

constexpr std::size_t block_side = 8, block_samples = block_side * block_side;
using BlockSamples = std::array<float, block_samples>;

// Interpolation between samples takes six of them along each axis, two of them before the first.
constexpr std::size_t taps = 6, taps_before = taps / 2 - 1, window_side = block_side + taps - 1;
using Taps = std::array<float, taps>;

// A block from a window of rows `stride` samples apart, with window_side samples along each axis with weights;
// interpolated along u, along v, or where the weights are null not at all.
void interpolate_block(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                       BlockSamples& block);
void interpolate_block_plain(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                             BlockSamples& block);

// weight_a a + weight_b b; `out` may be a or b.
void mix_blocks(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b, BlockSamples& out);
void mix_blocks_plain(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b, BlockSamples& out);

// The same into `out`, which is neither. Returns Σ (out − wanted)².
float mix_and_compare(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b,
                      const BlockSamples& wanted, BlockSamples& out);
float mix_and_compare_plain(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b,
                            const BlockSamples& wanted, BlockSamples& out);

// Σ (a − b)², of a block in rows `stride` samples apart.
float squared_difference(const float* a, std::size_t stride, const BlockSamples& b);
float squared_difference_plain(const float* a, std::size_t stride, const BlockSamples& b);
inline float squared_difference(const BlockSamples& a, const BlockSamples& b) {
    return squared_difference(a.data(), block_side, b);
}

// The same of rows of any length, in eight sums: of every eighth sample.
double squared_difference_of_rows(const float* a, const float* b, std::size_t count);
double squared_difference_of_rows_plain(const float* a, const float* b, std::size_t count);

// Σ (a − b) slope, and Σ slope².
struct AlongSlope {
    float difference, square;
    friend bool operator==(const AlongSlope&, const AlongSlope&) = default;
};
AlongSlope along_slope(const BlockSamples& a, const BlockSamples& b, const BlockSamples& slope);
AlongSlope along_slope_plain(const BlockSamples& a, const BlockSamples& b, const BlockSamples& slope);

// Which samples have a size of `least` or more: a bit each.
std::uint64_t large_samples(const BlockSamples& block, float least);
std::uint64_t large_samples_plain(const BlockSamples& block, float least);

// Σ a², in sums as above.
double sum_of_squares(const float* a, std::size_t count);
double sum_of_squares_plain(const float* a, std::size_t count);

// How much a block changes from sample to sample along u and v, from a window of slope_window_side rows.
constexpr float slope_of_near = 2.0f / 3, slope_of_far = 1.0f / 12;  // of samples next to it and beyond: of third order
constexpr std::size_t slope_reach = 2, slope_window_side = block_side + 2 * slope_reach;
struct Slopes {
    BlockSamples u, v;
    friend bool operator==(const Slopes&, const Slopes&) = default;
};
void slopes_of_block(const float* rows, std::size_t stride, Slopes& slopes);
void slopes_of_block_plain(const float* rows, std::size_t stride, Slopes& slopes);

// For each line that may cut a block, what is the best found so far for the samples on one side of it.
constexpr std::size_t block_lines = 128;
using OfLines = std::array<float, block_lines>;
struct BestOfLines {
    OfLines cost, way;
    friend bool operator==(const BestOfLines&, const BestOfLines&) = default;
};
// Which samples of a row lie beyond a line, [row][line]: for n < block_side the first n of them, else all from
// n − block_side on.
constexpr std::size_t row_cuts = 2 * block_side;
constexpr bool sample_in_cut(std::size_t column, std::size_t cut) {
    return cut < block_side ? column < cut : column >= cut - block_side;
}
using LinesInRows = std::array<std::array<std::int32_t, block_lines>, block_side>;
// Takes `way` where the squared differences of its prediction, summed over the samples beyond a line or over the
// others, and `more` are less than what is there.
void take_better(const BlockSamples& prediction, const BlockSamples& wanted, float more, float way,
                 const LinesInRows& lines, BestOfLines& main, BestOfLines& beyond);
void take_better_plain(const BlockSamples& prediction, const BlockSamples& wanted, float more, float way,
                       const LinesInRows& lines, BestOfLines& main, BestOfLines& beyond);

// in · transposed, which transforms along u; `out` is another block.
void transform_along_u(const BlockSamples& transposed, const BlockSamples& in, BlockSamples& out);
void transform_along_u_plain(const BlockSamples& transposed, const BlockSamples& in, BlockSamples& out);

// matrix · in, which transforms along v; the same.
void transform_along_v(const BlockSamples& matrix, const BlockSamples& in, BlockSamples& out);
void transform_along_v_plain(const BlockSamples& matrix, const BlockSamples& in, BlockSamples& out);

// matrix · in · matrixᵀ, along u first; the transposed matrix is given too.
void transform_both_ways(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                         BlockSamples& out);
void transform_both_ways_plain(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                               BlockSamples& out);

}  // namespace hogel::codec::format
