#include <algorithm>

#include "hogel/codec/block_kernels_internal.h"

namespace hogel {

void interpolate_block_plain(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                             BlockSamples& block) {
    float across[window_side * block_side];
    for (std::size_t r = 0; r < window_side; ++r) {
        const float* in = rows + r * stride;
        float* out = across + r * block_side;
        for (std::size_t c = 0; c < block_side; ++c) {
            if (!along_u) {
                out[c] = in[taps_before + c];
                continue;
            }
            float sum = (*along_u)[0] * in[c];
            for (std::size_t k = 1; k < taps; ++k) sum += (*along_u)[k] * in[c + k];
            out[c] = sum;
        }
    }
    for (std::size_t r = 0; r < block_side; ++r)
        for (std::size_t c = 0; c < block_side; ++c) {
            float& out = block[r * block_side + c];
            if (!along_v) {
                out = across[(r + taps_before) * block_side + c];
                continue;
            }
            out = (*along_v)[0] * across[r * block_side + c];
            for (std::size_t k = 1; k < taps; ++k) out += (*along_v)[k] * across[(r + k) * block_side + c];
        }
}

float squared_difference_plain(const BlockSamples& a, const BlockSamples& b) {
    float of_column[block_side] = {};
    for (std::size_t r = 0; r < block_samples; r += block_side)
        for (std::size_t c = 0; c < block_side; ++c) {
            const float difference = a[r + c] - b[r + c];
            of_column[c] += difference * difference;
        }
    float sum = 0;
    for (const float part : of_column) sum += part;
    return sum;
}

void take_better_plain(const BlockSamples& errors, float more, float way, const LinesOfSamples& lines,
                       BestOfLines& main, BestOfLines& beyond) {
    float all = more;
    for (const float error : errors) all += error;
    for (std::size_t line = 0; line < block_lines; ++line) {
        float sum = 0;
        for (std::size_t n = 0; n < block_samples; ++n) sum += errors[n] * lines[n][line];
        if (all - sum < main.cost[line]) {
            main.cost[line] = all - sum;
            main.way[line] = way;
        }
        if (more + sum < beyond.cost[line]) {
            beyond.cost[line] = more + sum;
            beyond.way[line] = way;
        }
    }
}

void transform_both_ways_plain(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                               BlockSamples& out) {
    BlockSamples across;  // in · matrixᵀ
    for (std::size_t r = 0; r < block_side; ++r) {
        float sum[block_side] = {};
        for (std::size_t j = 0; j < block_side; ++j)
            for (std::size_t k = 0; k < block_side; ++k)
                sum[k] += in[r * block_side + j] * transposed[j * block_side + k];
        std::copy_n(sum, block_side, &across[r * block_side]);
    }
    for (std::size_t k = 0; k < block_side; ++k) {
        float sum[block_side] = {};
        for (std::size_t r = 0; r < block_side; ++r)
            for (std::size_t c = 0; c < block_side; ++c)
                sum[c] += matrix[k * block_side + r] * across[r * block_side + c];
        std::copy_n(sum, block_side, &out[k * block_side]);
    }
}

}  // namespace hogel
