// SPDX-License-Identifier: Apache-2.0
// Vector twins of block_kernels.cpp, compiled for every SIMD target and selected at the first call. Products are
// rounded before they are added, as in the plain versions.
#include "hogel/codec/format/block_kernels.h"
#include "hogel/core/simd_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::codec::format::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Row = hn::CappedTag<float, block_side>;       // a row of a block, or an even part of one
using Rows = hn::CappedTag<float, 2 * block_side>;  // two consecutive rows or parts

// Interpolates rows of a block, or of a window for it, along u.
HWY_INLINE void AlongRows(const float* rows, std::size_t stride, std::size_t count, const Taps& weights, float* out) {
    const Row d;
    const auto w0 = hn::Set(d, weights[0]), w1 = hn::Set(d, weights[1]), w2 = hn::Set(d, weights[2]);
    const auto w3 = hn::Set(d, weights[3]), w4 = hn::Set(d, weights[4]), w5 = hn::Set(d, weights[5]);
    for (std::size_t c = 0; c < block_side; c += hn::Lanes(d)) {
        const float* in = rows + c;
        float* to = out + c;
        for (std::size_t r = 0; r < count; ++r, in += stride, to += block_side) {
            auto sum = hn::Mul(w0, hn::LoadU(d, in));
            sum = hn::Add(sum, hn::Mul(w1, hn::LoadU(d, in + 1)));
            sum = hn::Add(sum, hn::Mul(w2, hn::LoadU(d, in + 2)));
            sum = hn::Add(sum, hn::Mul(w3, hn::LoadU(d, in + 3)));
            sum = hn::Add(sum, hn::Mul(w4, hn::LoadU(d, in + 4)));
            sum = hn::Add(sum, hn::Mul(w5, hn::LoadU(d, in + 5)));
            hn::StoreU(sum, d, to);
        }
    }
}

HWY_INLINE void AlongColumns(const float* rows, std::size_t stride, const Taps& weights, float* out) {
    const Row d;
    for (std::size_t c = 0; c < block_side; c += hn::Lanes(d)) {
        // A loaded row is used by up to six rows of the block.
        const float* in = rows + c;
        auto r0 = hn::LoadU(d, in), r1 = hn::LoadU(d, in + stride), r2 = hn::LoadU(d, in + 2 * stride);
        auto r3 = hn::LoadU(d, in + 3 * stride), r4 = hn::LoadU(d, in + 4 * stride);
        in += 5 * stride;
        const auto w0 = hn::Set(d, weights[0]), w1 = hn::Set(d, weights[1]), w2 = hn::Set(d, weights[2]);
        const auto w3 = hn::Set(d, weights[3]), w4 = hn::Set(d, weights[4]), w5 = hn::Set(d, weights[5]);
        for (std::size_t r = 0; r < block_side; ++r, in += stride) {
            const auto r5 = hn::LoadU(d, in);
            auto sum = hn::Mul(w0, r0);
            sum = hn::Add(sum, hn::Mul(w1, r1));
            sum = hn::Add(sum, hn::Mul(w2, r2));
            sum = hn::Add(sum, hn::Mul(w3, r3));
            sum = hn::Add(sum, hn::Mul(w4, r4));
            sum = hn::Add(sum, hn::Mul(w5, r5));
            hn::StoreU(sum, d, out + r * block_side + c);
            r0 = r1;
            r1 = r2;
            r2 = r3;
            r3 = r4;
            r4 = r5;
        }
    }
}

void InterpolateBlock(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                      BlockSamples& block) {
    if (!along_u && !along_v) {
        const Row d;
        for (std::size_t r = 0; r < block_side; ++r)
            for (std::size_t c = 0; c < block_side; c += hn::Lanes(d))
                hn::StoreU(hn::LoadU(d, rows + r * stride + c), d, &block[r * block_side + c]);
    } else if (!along_v) {
        AlongRows(rows, stride, block_side, *along_u, block.data());
    } else if (!along_u) {
        AlongColumns(rows, stride, *along_v, block.data());
    } else {
        HWY_ALIGN float across[window_side * block_side];
        AlongRows(rows, stride, window_side, *along_u, across);
        AlongColumns(across, block_side, *along_v, block.data());
    }
}

void MixBlocks(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b, BlockSamples& out) {
    const Rows d;
    const auto of_a = hn::Set(d, weight_a), of_b = hn::Set(d, weight_b);
    for (std::size_t k = 0; k < block_samples; k += hn::Lanes(d))
        hn::StoreU(hn::Add(hn::Mul(of_a, hn::LoadU(d, &a[k])), hn::Mul(of_b, hn::LoadU(d, &b[k]))), d, &out[k]);
}

// Twin of the plain sum_in_columns(). term(d, k) returns a vector of terms starting at index k.
template <class Term>
HWY_INLINE float SumInColumns(Term&& term) {
    const Row d;
    HWY_ALIGN float sum[block_side];
    for (std::size_t c = 0; c < block_side; c += hn::Lanes(d)) {
        auto even = hn::Zero(d), odd = hn::Zero(d);
        for (std::size_t k = c; k < block_samples; k += 2 * block_side) {
            even = hn::Add(even, term(d, k));
            odd = hn::Add(odd, term(d, k + block_side));
        }
        hn::Store(hn::Add(even, odd), d, sum + c);
    }
    for (std::size_t half = block_side / 2; half > 0; half /= 2)
        for (std::size_t c = 0; c < half; ++c) sum[c] += sum[c + half];
    return sum[0];
}

float MixAndCompare(const BlockSamples& a, const BlockSamples& b, float weight_a, float weight_b,
                    const BlockSamples& target, BlockSamples& out) {
    return SumInColumns([&](auto d, std::size_t k) HWY_ATTR {
        const auto mixed = hn::Add(hn::Mul(hn::Set(d, weight_a), hn::LoadU(d, &a[k])),
                                   hn::Mul(hn::Set(d, weight_b), hn::LoadU(d, &b[k])));
        hn::StoreU(mixed, d, &out[k]);
        const auto difference = hn::Sub(mixed, hn::LoadU(d, &target[k]));
        return hn::Mul(difference, difference);
    });
}

float SquaredDifference(const float* a, std::size_t stride, const BlockSamples& b) {
    return SumInColumns([&](auto d, std::size_t k) HWY_ATTR {
        const float* samples = a + k / block_side * stride + k % block_side;
        const auto difference = hn::Sub(hn::LoadU(d, samples), hn::LoadU(d, &b[k]));
        return hn::Mul(difference, difference);
    });
}

using Doubles = hn::CappedTag<double, block_side / 2>;
using FloatsOfDoubles = hn::Rebind<float, Doubles>;

// Returns Σ value² in eight partial sums; vector(k) returns a vector of values starting at index k, value(k) a single
// one.
template <class Vector, class Value>
HWY_INLINE double SumOfSquares(std::size_t count, Vector&& vector, Value&& value) {
    const Doubles d;
    HWY_ALIGN double sum[block_side];
    const std::size_t full_blocks = count / block_side * block_side;
    constexpr std::size_t half = block_side / 2;
    for (std::size_t c = 0; c < half; c += hn::Lanes(d)) {
        auto low = hn::Zero(d), high = hn::Zero(d);
        for (std::size_t k = c; k < full_blocks; k += block_side) {
            const auto current = vector(k), next = vector(k + half);
            low = hn::Add(low, hn::Mul(current, current));
            high = hn::Add(high, hn::Mul(next, next));
        }
        hn::Store(low, d, sum + c);
        hn::Store(high, d, sum + half + c);
    }
    for (std::size_t k = full_blocks; k < count; ++k) sum[k % block_side] += value(k) * value(k);
    double total = 0;
    for (const double s : sum) total += s;
    return total;
}

double SquaredDifferenceOfRows(const float* a, const float* b, std::size_t count) {
    const Doubles d;
    const FloatsOfDoubles f;
    return SumOfSquares(
        count,
        [&](std::size_t k)
            HWY_ATTR { return hn::Sub(hn::PromoteTo(d, hn::LoadU(f, a + k)), hn::PromoteTo(d, hn::LoadU(f, b + k))); },
        [&](std::size_t k) { return static_cast<double>(a[k]) - static_cast<double>(b[k]); });
}

double SumOfSquaresOf(const float* a, std::size_t count) {
    const Doubles d;
    const FloatsOfDoubles f;
    return SumOfSquares(
        count, [&](std::size_t k) HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(f, a + k)); },
        [&](std::size_t k) { return static_cast<double>(a[k]); });
}

std::uint64_t LargeSamples(const BlockSamples& block, float min_magnitude) {
    const Row d;
    const auto bound = hn::Set(d, min_magnitude);
    std::uint64_t large = 0;
    for (std::size_t k = 0; k < block_samples; k += hn::Lanes(d)) {
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Ge(hn::Abs(hn::LoadU(d, &block[k])), bound), bits);
        large |= std::uint64_t{bits[0]} << k;
    }
    return large;
}

AlongSlope AlongSlopeOf(const BlockSamples& a, const BlockSamples& b, const BlockSamples& slope) {
    return {SumInColumns([&](auto d, std::size_t k) HWY_ATTR {
                return hn::Mul(hn::Sub(hn::LoadU(d, &a[k]), hn::LoadU(d, &b[k])), hn::LoadU(d, &slope[k]));
            }),
            SumInColumns([&](auto d, std::size_t k) HWY_ATTR {
                const auto current = hn::LoadU(d, &slope[k]);
                return hn::Mul(current, current);
            })};
}

void SlopesOfBlock(const float* rows, std::size_t stride, Slopes& slopes) {
    const Row d;
    const auto adjacent = hn::Set(d, slope_of_near), distant = hn::Set(d, slope_of_far);
    const auto slope = [&](const float* samples, std::size_t next) HWY_ATTR {
        return hn::Sub(hn::Mul(adjacent, hn::Sub(hn::LoadU(d, samples + next), hn::LoadU(d, samples - next))),
                       hn::Mul(distant, hn::Sub(hn::LoadU(d, samples + 2 * next), hn::LoadU(d, samples - 2 * next))));
    };
    for (std::size_t r = 0; r < block_side; ++r)
        for (std::size_t c = 0; c < block_side; c += hn::Lanes(d)) {
            const float* samples = rows + (r + slope_reach) * stride + slope_reach + c;
            hn::StoreU(slope(samples, 1), d, &slopes.u[r * block_side + c]);
            hn::StoreU(slope(samples, stride), d, &slopes.v[r * block_side + c]);
        }
}

// [column][cut]: 1 if the cut contains the sample of that column, otherwise 0.
struct CutsOfRow {
    HWY_ALIGN float of[block_side][row_cuts];
    constexpr CutsOfRow() : of() {
        for (std::size_t c = 0; c < block_side; ++c)
            for (std::size_t cut = 0; cut < row_cuts; ++cut) of[c][cut] = sample_in_cut(c, cut) ? 1.0f : 0.0f;
    }
};
constexpr CutsOfRow cuts;

void KeepBetter(const BlockSamples& prediction, const BlockSamples& target, float extra, float choice,
                const EdgeRowCuts& edges, BestPerEdge& main, BestPerEdge& second) {
    const hn::CappedTag<float, row_cuts> d;
    const hn::RebindToSigned<decltype(d)> indices;
    const std::size_t lanes = hn::Lanes(d);
    HWY_ALIGN float errors[block_samples];
    for (std::size_t k = 0; k < block_samples; k += lanes) {
        const auto difference = hn::Sub(hn::LoadU(d, &prediction[k]), hn::LoadU(d, &target[k]));
        hn::Store(hn::Mul(difference, difference), d, errors + k);
    }
    // Sums over all cuts of each row. Products with 0 and 1 are exact, so a fused multiply-add gives the same bits.
    HWY_ALIGN float sums[block_side][row_cuts];
    for (std::size_t cut = 0; cut < row_cuts; cut += lanes)
        for (std::size_t r = 0; r < block_side; ++r) {
            auto sum = hn::Zero(d);
            for (std::size_t c = 0; c < block_side; ++c)
                sum = hn::MulAdd(hn::Set(d, errors[r * block_side + c]), hn::Load(d, cuts.of[c] + cut), sum);
            hn::Store(sum, d, sums[r] + cut);
        }
    float total = sums[0][block_side];
    for (std::size_t r = 1; r < block_side; ++r) total += sums[r][block_side];
    const auto in_row = [&](std::size_t r, std::size_t edge) HWY_ATTR {
        const auto cut = hn::LoadU(indices, &edges[r][edge]);
#if !HWY_HAVE_SCALABLE
        if constexpr (hn::MaxLanes(d) == row_cuts)
            return hn::TableLookupLanes(hn::Load(d, sums[r]), hn::IndicesFromVec(d, cut));
        if constexpr (2 * hn::MaxLanes(d) == row_cuts) {
            const auto half = hn::Set(indices, static_cast<std::int32_t>(lanes));
            const auto in_half = hn::IndicesFromVec(d, hn::And(cut, hn::Set(indices, std::int32_t(lanes) - 1)));
            return hn::IfThenElse(hn::RebindMask(d, hn::Lt(cut, half)),
                                  hn::TableLookupLanes(hn::Load(d, sums[r]), in_half),
                                  hn::TableLookupLanes(hn::Load(d, sums[r] + lanes), in_half));
        }
#endif
        return hn::GatherIndex(d, sums[r], cut);
    };
    const auto keep = [&](auto cost, std::size_t edge, BestPerEdge& best) HWY_ATTR {
        const auto so_far = hn::LoadU(d, &best.cost[edge]);
        const auto better = hn::Lt(cost, so_far);
        hn::StoreU(hn::IfThenElse(better, cost, so_far), d, &best.cost[edge]);
        hn::StoreU(hn::IfThenElse(better, hn::Set(d, choice), hn::LoadU(d, &best.choice[edge])), d, &best.choice[edge]);
    };
    const auto full_blocks = hn::Set(d, total), added = hn::Set(d, extra);
    for (std::size_t edge = 0; edge < block_edges; edge += lanes) {
        auto sum = in_row(0, edge);
        for (std::size_t r = 1; r < block_side; ++r) sum = hn::Add(sum, in_row(r, edge));
        keep(hn::Add(hn::Sub(full_blocks, sum), added), edge, main);
        keep(hn::Add(sum, added), edge, second);
    }
}

void TransformAlongU(const BlockSamples& transposed, const BlockSamples& in, BlockSamples& out) {
    const Row d;
    for (std::size_t c = 0; c < block_side; c += hn::Lanes(d))
        for (std::size_t r = 0; r < block_side; ++r) {
            auto sum = hn::Zero(d);
            for (std::size_t j = 0; j < block_side; ++j)
                sum = hn::Add(
                    sum, hn::Mul(hn::Set(d, in[r * block_side + j]), hn::LoadU(d, &transposed[j * block_side + c])));
            hn::StoreU(sum, d, &out[r * block_side + c]);
        }
}

void TransformAlongV(const BlockSamples& matrix, const BlockSamples& in, BlockSamples& out) {
    const Row d;
    for (std::size_t c = 0; c < block_side; c += hn::Lanes(d))
        for (std::size_t k = 0; k < block_side; ++k) {
            auto sum = hn::Zero(d);
            for (std::size_t r = 0; r < block_side; ++r)
                sum = hn::Add(sum,
                              hn::Mul(hn::Set(d, matrix[k * block_side + r]), hn::LoadU(d, &in[r * block_side + c])));
            hn::StoreU(sum, d, &out[k * block_side + c]);
        }
}

void TransformBothWays(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                       BlockSamples& out) {
    BlockSamples across;
    TransformAlongU(transposed, in, across);
    TransformAlongV(matrix, across, out);
}

}  // namespace hogel::codec::format::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::codec::format {

HWY_EXPORT(SquaredDifference);

HOGEL_DISPATCH(interpolate_block, InterpolateBlock);
HOGEL_DISPATCH(mix_blocks, MixBlocks);
HOGEL_DISPATCH(mix_and_compare, MixAndCompare);

float squared_difference(const float* a, std::size_t stride, const BlockSamples& b) {
    return HWY_DYNAMIC_DISPATCH(SquaredDifference)(a, stride, b);
}

HOGEL_DISPATCH(squared_difference_of_rows, SquaredDifferenceOfRows);
HOGEL_DISPATCH(sum_of_squares, SumOfSquaresOf);
HOGEL_DISPATCH(large_samples, LargeSamples);
HOGEL_DISPATCH(along_slope, AlongSlopeOf);
HOGEL_DISPATCH(slopes_of_block, SlopesOfBlock);
HOGEL_DISPATCH(keep_better, KeepBetter);
HOGEL_DISPATCH(transform_along_u, TransformAlongU);
HOGEL_DISPATCH(transform_along_v, TransformAlongV);
HOGEL_DISPATCH(transform_both_ways, TransformBothWays);

}  // namespace hogel::codec::format
#endif
