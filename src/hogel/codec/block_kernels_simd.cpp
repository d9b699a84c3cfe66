// The vector twins of block_kernels.cpp, compiled for every instruction set and chosen when first called. Products are
// rounded before they are added, as there.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/codec/block_kernels_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "hogel/codec/block_kernels_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Row = hn::CappedTag<float, block_side>;  // a row of a block, or an even part of one

void InterpolateBlock(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                      BlockSamples& block) {
    const Row d;
    HWY_ALIGN float across[window_side * block_side];
    const std::size_t first = along_v ? 0 : taps_before, last = along_v ? window_side : taps_before + block_side;
    for (std::size_t c = 0; c < block_side; c += hn::Lanes(d)) {
        const float* in = rows + first * stride + c;
        if (along_u) {
            const auto w0 = hn::Set(d, (*along_u)[0]), w1 = hn::Set(d, (*along_u)[1]), w2 = hn::Set(d, (*along_u)[2]);
            const auto w3 = hn::Set(d, (*along_u)[3]), w4 = hn::Set(d, (*along_u)[4]), w5 = hn::Set(d, (*along_u)[5]);
            for (std::size_t r = first; r < last; ++r, in += stride) {
                auto sum = hn::Mul(w0, hn::LoadU(d, in));
                sum = hn::Add(sum, hn::Mul(w1, hn::LoadU(d, in + 1)));
                sum = hn::Add(sum, hn::Mul(w2, hn::LoadU(d, in + 2)));
                sum = hn::Add(sum, hn::Mul(w3, hn::LoadU(d, in + 3)));
                sum = hn::Add(sum, hn::Mul(w4, hn::LoadU(d, in + 4)));
                sum = hn::Add(sum, hn::Mul(w5, hn::LoadU(d, in + 5)));
                hn::Store(sum, d, across + r * block_side + c);
            }
        } else {
            for (std::size_t r = first; r < last; ++r, in += stride)
                hn::Store(hn::LoadU(d, in + taps_before), d, across + r * block_side + c);
        }
        for (std::size_t r = 0; r < block_side; ++r) {
            float* out = &block[r * block_side + c];
            if (!along_v) {
                hn::StoreU(hn::Load(d, across + (r + taps_before) * block_side + c), d, out);
                continue;
            }
            auto sum = hn::Mul(hn::Set(d, (*along_v)[0]), hn::Load(d, across + r * block_side + c));
            for (std::size_t k = 1; k < taps; ++k)
                sum = hn::Add(sum, hn::Mul(hn::Set(d, (*along_v)[k]), hn::Load(d, across + (r + k) * block_side + c)));
            hn::StoreU(sum, d, out);
        }
    }
}

float SquaredDifference(const BlockSamples& a, const BlockSamples& b) {
    const Row d;
    HWY_ALIGN float of_column[block_side];
    for (std::size_t c = 0; c < block_side; c += hn::Lanes(d)) {
        auto sum = hn::Zero(d);
        for (std::size_t r = 0; r < block_samples; r += block_side) {
            const auto difference = hn::Sub(hn::LoadU(d, &a[r + c]), hn::LoadU(d, &b[r + c]));
            sum = hn::Add(sum, hn::Mul(difference, difference));
        }
        hn::Store(sum, d, of_column + c);
    }
    float sum = 0;
    for (const float part : of_column) sum += part;
    return sum;
}

void TakeBetter(const BlockSamples& errors, float more, float way, const LinesOfSamples& lines, BestOfLines& main,
                BestOfLines& beyond) {
    const hn::CappedTag<float, block_lines / 4> d;
    const std::size_t lanes = hn::Lanes(d);
    float all = more;
    for (const float error : errors) all += error;
    const auto take = [&](auto cost, std::size_t line, BestOfLines& best) HWY_ATTR {
        const auto so_far = hn::LoadU(d, &best.cost[line]);
        const auto better = hn::Lt(cost, so_far);
        hn::StoreU(hn::IfThenElse(better, cost, so_far), d, &best.cost[line]);
        hn::StoreU(hn::IfThenElse(better, hn::Set(d, way), hn::LoadU(d, &best.way[line])), d, &best.way[line]);
    };
    for (std::size_t line = 0; line < block_lines; line += 4 * lanes) {
        // Four vectors at once, as each sum waits for the one before it.
        auto a = hn::Zero(d), b = a, c = a, e = a;
        for (std::size_t n = 0; n < block_samples; ++n) {
            const auto error = hn::Set(d, errors[n]);
            const float* row = &lines[n][line];
            a = hn::Add(a, hn::Mul(error, hn::LoadU(d, row)));
            b = hn::Add(b, hn::Mul(error, hn::LoadU(d, row + lanes)));
            c = hn::Add(c, hn::Mul(error, hn::LoadU(d, row + 2 * lanes)));
            e = hn::Add(e, hn::Mul(error, hn::LoadU(d, row + 3 * lanes)));
        }
        std::size_t at = line;
        for (const auto sum : {a, b, c, e}) {
            take(hn::Sub(hn::Set(d, all), sum), at, main);
            take(hn::Add(hn::Set(d, more), sum), at, beyond);
            at += lanes;
        }
    }
}

void TransformBothWays(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                       BlockSamples& out) {
    const Row d;
    HWY_ALIGN float across[block_samples];
    for (std::size_t c = 0; c < block_side; c += hn::Lanes(d)) {
        for (std::size_t r = 0; r < block_side; ++r) {
            auto sum = hn::Zero(d);
            for (std::size_t j = 0; j < block_side; ++j)
                sum = hn::Add(
                    sum, hn::Mul(hn::Set(d, in[r * block_side + j]), hn::LoadU(d, &transposed[j * block_side + c])));
            hn::Store(sum, d, across + r * block_side + c);
        }
        for (std::size_t k = 0; k < block_side; ++k) {
            auto sum = hn::Zero(d);
            for (std::size_t r = 0; r < block_side; ++r)
                sum = hn::Add(
                    sum, hn::Mul(hn::Set(d, matrix[k * block_side + r]), hn::Load(d, across + r * block_side + c)));
            hn::StoreU(sum, d, &out[k * block_side + c]);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(InterpolateBlock);
HWY_EXPORT(SquaredDifference);
HWY_EXPORT(TakeBetter);
HWY_EXPORT(TransformBothWays);

void interpolate_block(const float* rows, std::size_t stride, const Taps* along_u, const Taps* along_v,
                       BlockSamples& block) {
    HWY_DYNAMIC_DISPATCH(InterpolateBlock)(rows, stride, along_u, along_v, block);
}

float squared_difference(const BlockSamples& a, const BlockSamples& b) {
    return HWY_DYNAMIC_DISPATCH(SquaredDifference)(a, b);
}

void take_better(const BlockSamples& errors, float more, float way, const LinesOfSamples& lines, BestOfLines& main,
                 BestOfLines& beyond) {
    HWY_DYNAMIC_DISPATCH(TakeBetter)(errors, more, way, lines, main, beyond);
}

void transform_both_ways(const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                         BlockSamples& out) {
    HWY_DYNAMIC_DISPATCH(TransformBothWays)(matrix, transposed, in, out);
}

}  // namespace hogel
#endif
