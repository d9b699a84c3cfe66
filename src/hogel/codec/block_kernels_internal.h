#pragma once

#include <array>
#include <cstddef>

namespace hogel {

// The innermost loops of the coder "hogel": on a vector of samples where the machine has one, and plain. Both give the
// same bits, because what is added to what in which order is part of the format.

constexpr std::size_t block_side = 8, block_samples = block_side * block_side;
using BlockSamples = std::array<float, block_samples>;

// Interpolation between samples takes six of them along each axis, two of them before the first.
constexpr std::size_t taps = 6, taps_before = taps / 2 - 1, window_side = block_side + taps - 1;
using Taps = std::array<float, taps>;

// A block from a window of window_side rows, the next one `stride` samples on; interpolated along u, along v, or where
// the weights are null not at all.
void interpolate_block(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                       BlockSamples& block);
void interpolate_block_plain(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                             BlockSamples& block);

// Σ (a − b)².
float squared_difference(const BlockSamples& a, const BlockSamples& b);
float squared_difference_plain(const BlockSamples& a, const BlockSamples& b);

// For each line that may cut a block, what is the best found so far for the samples on one side of it.
constexpr std::size_t block_lines = 128;
using OfLines = std::array<float, block_lines>;
using LinesOfSamples = std::array<OfLines, block_samples>;  // 1 where a sample lies beyond a line, else 0
struct BestOfLines {
    OfLines cost, way;
    friend bool operator==(const BestOfLines&, const BestOfLines&) = default;
};
// Takes `way` where its errors, summed over the samples beyond a line or over the others, and `more` are less than what
// is there.
void take_better(const BlockSamples& errors, float more, float way, const LinesOfSamples& lines, BestOfLines& main,
                 BestOfLines& beyond);
void take_better_plain(const BlockSamples& errors, float more, float way, const LinesOfSamples& lines,
                       BestOfLines& main, BestOfLines& beyond);

// matrix · in · matrixᵀ; the transposed matrix is given too.
void transform_both_ways(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                         BlockSamples& out);
void transform_both_ways_plain(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                               BlockSamples& out);

}  // namespace hogel
