// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "hogel/codec/format/block_kernels.h"

namespace hogel::codec::format {
namespace {

// Returns a sum over a block in a fixed order that vectors of up to eight lanes reproduce bit for bit: even and odd
// rows column by column, then halves.
template <class Term>
float sum_in_columns(Term&& term) {
    float sum[2][block_side] = {};
    for (std::size_t k = 0; k < block_samples; ++k) sum[k / block_side % 2][k % block_side] += term(k);
    for (std::size_t c = 0; c < block_side; ++c) sum[0][c] += sum[1][c];
    for (std::size_t half = block_side / 2; half > 0; half /= 2)
        for (std::size_t c = 0; c < half; ++c) sum[0][c] += sum[0][c + half];
    return sum[0][0];
}

template <class Value>
double sum_of_squares_in_eight(std::size_t count, Value&& value) {
    double sum[block_side] = {};
    for (std::size_t k = 0; k < count; ++k) sum[k % block_side] += value(k) * value(k);
    return std::accumulate(std::begin(sum), std::end(sum), 0.0);
}

}  // namespace

void interpolate_block_plain(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                             BlockSamples& block) {
    float across[window_side * block_side];
    const std::size_t count = along_v ? window_side : block_side;
    for (std::size_t r = 0; r < count; ++r) {
        const float* in = rows + r * stride;
        float* out = across + r * block_side;
        for (std::size_t c = 0; c < block_side; ++c) {
            if (!along_u) {
                out[c] = in[c];
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
                out = across[r * block_side + c];
                continue;
            }
            out = (*along_v)[0] * across[r * block_side + c];
            for (std::size_t k = 1; k < taps; ++k) out += (*along_v)[k] * across[(r + k) * block_side + c];
        }
}

void mix_blocks_plain(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b, BlockSamples& out) {
    for (std::size_t k = 0; k < block_samples; ++k) out[k] = weight_a * a[k] + weight_b * b[k];
}

float mix_and_compare_plain(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b,
                            const BlockSamples& target, BlockSamples& out) {
    mix_blocks_plain(a, b, weight_a, weight_b, out);
    return squared_difference_plain(out.data(), block_side, target);
}

float squared_difference_plain(const float* a, std::size_t stride, const BlockSamples& b) {
    return sum_in_columns([&](std::size_t k) {
        const float difference = a[k / block_side * stride + k % block_side] - b[k];
        return difference * difference;
    });
}

double squared_difference_of_rows_plain(const float* a, const float* b, std::size_t count) {
    return sum_of_squares_in_eight(
        count, [&](std::size_t k) { return static_cast<double>(a[k]) - static_cast<double>(b[k]); });
}

double sum_of_squares_plain(const float* a, std::size_t count) {
    return sum_of_squares_in_eight(count, [&](std::size_t k) { return static_cast<double>(a[k]); });
}

AlongSlope along_slope_plain(const BlockSamples& a, const BlockSamples& b, const BlockSamples& slope) {
    return {sum_in_columns([&](std::size_t k) { return (a[k] - b[k]) * slope[k]; }),
            sum_in_columns([&](std::size_t k) { return slope[k] * slope[k]; })};
}

std::uint64_t large_samples_plain(const BlockSamples& block, float min_magnitude) {
    std::uint64_t large = 0;
    for (std::size_t k = 0; k < block_samples; ++k)
        if (std::abs(block[k]) >= min_magnitude) large |= std::uint64_t{1} << k;
    return large;
}

void slopes_of_block_plain(const float* rows, std::size_t stride, Slopes& slopes) {
    for (std::size_t r = 0; r < block_side; ++r)
        for (std::size_t c = 0; c < block_side; ++c) {
            const float* center = rows + (r + slope_reach) * stride + c + slope_reach;
            const auto slope = [center](std::ptrdiff_t next) {
                return slope_of_near * (center[next] - center[-next]) -
                       slope_of_far * (center[2 * next] - center[-2 * next]);
            };
            slopes.u[r * block_side + c] = slope(1);
            slopes.v[r * block_side + c] = slope(static_cast<std::ptrdiff_t>(stride));
        }
}

void keep_better_plain(const BlockSamples& prediction, const BlockSamples& target, float extra, float choice,
                       const EdgeRowCuts& edges, BestPerEdge& main, BestPerEdge& second) {
    std::array<std::array<float, row_cuts>, block_side> sums{};
    for (std::size_t n = 0; n < block_samples; ++n) {
        const float difference = prediction[n] - target[n], error = difference * difference;
        for (std::size_t cut = 0; cut < row_cuts; ++cut)
            if (sample_in_cut(n % block_side, cut)) sums[n / block_side][cut] += error;
    }
    float total = sums[0][block_side];
    for (std::size_t r = 1; r < block_side; ++r) total += sums[r][block_side];
    for (std::size_t edge = 0; edge < block_edges; ++edge) {
        const auto in_row = [&](std::size_t r) { return sums[r][static_cast<std::size_t>(edges[r][edge])]; };
        float sum = in_row(0);
        for (std::size_t r = 1; r < block_side; ++r) sum += in_row(r);
        const float of_main = total - sum + extra, of_second = sum + extra;
        if (of_main < main.cost[edge]) {
            main.cost[edge] = of_main;
            main.choice[edge] = choice;
        }
        if (of_second < second.cost[edge]) {
            second.cost[edge] = of_second;
            second.choice[edge] = choice;
        }
    }
}

void transform_along_u_plain(const BlockSamples& transposed, const BlockSamples& in, BlockSamples& out) {
    for (std::size_t r = 0; r < block_side; ++r) {
        float sum[block_side] = {};
        for (std::size_t j = 0; j < block_side; ++j)
            for (std::size_t k = 0; k < block_side; ++k)
                sum[k] += in[r * block_side + j] * transposed[j * block_side + k];
        std::copy_n(sum, block_side, &out[r * block_side]);
    }
}

void transform_along_v_plain(const BlockSamples& matrix, const BlockSamples& in, BlockSamples& out) {
    for (std::size_t k = 0; k < block_side; ++k) {
        float sum[block_side] = {};
        for (std::size_t r = 0; r < block_side; ++r)
            for (std::size_t c = 0; c < block_side; ++c) sum[c] += matrix[k * block_side + r] * in[r * block_side + c];
        std::copy_n(sum, block_side, &out[k * block_side]);
    }
}

void transform_both_ways_plain(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                               BlockSamples& out) {
    BlockSamples across;
    transform_along_u_plain(transposed, in, across);
    transform_along_v_plain(matrix, across, out);
}

}  // namespace hogel::codec::format
