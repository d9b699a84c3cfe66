// SPDX-License-Identifier: Apache-2.0
// Vectors of samples for *_simd.cpp. To be included after hwy/highway.h, once for every SIMD target.
#if defined(HOGEL_RENDER_EPI_SHADING_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_RENDER_EPI_SHADING_LANES
#undef HOGEL_RENDER_EPI_SHADING_LANES
#else
#define HOGEL_RENDER_EPI_SHADING_LANES
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/lane_bits.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector of one lane cannot hold four values.
#if HWY_TARGET != HWY_SCALAR
#if HWY_HAVE_SCALABLE
using FloatTag = hn::FixedTag<float, 4>;
#else
using FloatTag = hn::ScalableTag<float>;
#endif
using NumberTag = hn::RebindToUnsigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Numbers = hn::Vec<NumberTag>;

// Loads four floats from each of address(0), address(4), … into consecutive blocks.
template <class Address>
HWY_INLINE Floats load_blocks(const Address& address) {
    const FloatTag d;
    constexpr std::size_t lanes = hn::MaxLanes(d);
    const auto in_all_blocks = [&](std::size_t i) HWY_ATTR { return hn::LoadDup128(d, address(i)); };
    if constexpr (lanes == 4)
        return in_all_blocks(0);
    else if constexpr (lanes == 8)
        return hn::OddEvenBlocks(in_all_blocks(4), in_all_blocks(0));
    else {
        // Half by half, because g++ 12 has an internal error for blends of blocks that are already in a register.
        const hn::Half<FloatTag> dh;
        const auto half = [&](std::size_t i) HWY_ATTR {
            return hn::OddEvenBlocks(hn::LoadDup128(dh, address(i + 4)), hn::LoadDup128(dh, address(i)));
        };
        return hn::Combine(d, half(8), half(0));
    }
}

// Loads four floats at `offset` from each of bases[0], bases[4], …
HWY_INLINE Floats load_blocks(const float* const* bases, std::size_t offset) {
    return load_blocks([=](std::size_t i) { return bases[i] + offset; });
}

// Transposes 4 × 4 floats per block: block b of v[i] holds four floats of sample 4 b + i, before or after.
HWY_INLINE void transpose(Floats (&v)[4]) {
    const FloatTag d;
    const hn::RepartitionToWide<FloatTag> dw;
    const auto wide = [&](Floats f) HWY_ATTR { return hn::BitCast(dw, f); };
    const auto a = wide(hn::InterleaveLower(d, v[0], v[1])), b = wide(hn::InterleaveLower(d, v[2], v[3]));
    const auto c = wide(hn::InterleaveUpper(d, v[0], v[1])), e = wide(hn::InterleaveUpper(d, v[2], v[3]));
    v[0] = hn::BitCast(d, hn::InterleaveLower(dw, a, b));
    v[1] = hn::BitCast(d, hn::InterleaveUpper(dw, a, b));
    v[2] = hn::BitCast(d, hn::InterleaveLower(dw, c, e));
    v[3] = hn::BitCast(d, hn::InterleaveUpper(dw, c, e));
}

// Computes position_on_span(), with one span per lane; `ends` are x0, z0, dx, dz.
HWY_INLINE Floats positions_on_spans(Floats n, Floats K, const Floats (&ends)[4]) {
    const FloatTag d;
    const auto& [x0, z0, dx, dz] = ends;
    const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const Floats position = hn::Div(hn::Add(hn::Sub(n, x0), hn::Mul(K, z0)), hn::Sub(dx, hn::Mul(K, dz)));
    const Floats positive = hn::IfThenElse(hn::Gt(position, zero), position, zero);
    return hn::IfThenElse(hn::Lt(positive, one), positive, one);
}

HWY_INLINE Floats positions_on_one(const SpanValues& span, Floats n, Floats K) {
    const FloatTag d;
    return positions_on_spans(n, K,
                              {hn::Set(d, span.x0), hn::Set(d, span.z0), hn::Set(d, span.dx), hn::Set(d, span.dz)});
}

HWY_INLINE Numbers numbers_of(const std::uint64_t* words) {
    const NumberTag du;
    const hn::RepartitionToWide<NumberTag> d64;
    return hn::ConcatEven(du, hn::BitCast(du, hn::LoadU(d64, words + hn::Lanes(d64))),
                          hn::BitCast(du, hn::LoadU(d64, words)));
}

// Writes all samples of a plane, and empties it. shade_vector(words, column, first direction, values) sets the values
// of a vector of samples; words after the end of a column are 0. shade_vector.begin(column), if any, is called first.
template <class ShadeVector>
HWY_INLINE void shade_vectors(const EpipolarPlane& plane, const PlaneOutput& out, const ShadeVector& shade_vector) {
    const FloatTag d;
    const hn::RepartitionToWide<NumberTag> d64;
    const std::size_t lanes = hn::Lanes(d), directions = plane.directions;
    const bool aligned = out.is_aligned_to(lanes);
    const auto empty = hn::Set(d64, EpipolarPlane::empty);
    for (std::size_t column = 0; column < plane.columns; ++column) {
        std::uint64_t* words = plane.words + column * directions;
        float* destination[4];
        for (int i = 0; i < 4; ++i) destination[i] = out.values[i] ? out.values[i] + column * out.strides[i] : nullptr;
        if constexpr (requires { shade_vector.begin(column); }) shade_vector.begin(column);
        std::size_t k = 0;
        for (; aligned && k + lanes <= directions; k += lanes, words += lanes) {
            Floats values[4];
            shade_vector(words, column, k, values);
            hn::StoreU(empty, d64, words);
            hn::StoreU(empty, d64, words + lanes / 2);
            // Non-temporal stores, because samples are not read again soon.
            if (destination[0]) hn::Stream(values[0], d, destination[0] + k);
            if (destination[1]) hn::Stream(values[1], d, destination[1] + k);
            if (destination[2]) hn::Stream(values[2], d, destination[2] + k);
            if (destination[3]) hn::Stream(values[3], d, destination[3] + k);
        }
        for (; k < directions; k += lanes, words += lanes) {
            const std::size_t count = std::min(lanes, directions - k);
            HWY_ALIGN std::uint64_t tail_words[hn::MaxLanes(d)] = {};
            std::copy_n(words, count, tail_words);
            std::fill_n(words, count, EpipolarPlane::empty);
            Floats values[4];
            shade_vector(tail_words, column, k, values);
            for (int i = 0; i < 4; ++i) {
                if (!destination[i]) continue;
                HWY_ALIGN float tail_values[hn::MaxLanes(d)];
                hn::Store(values[i], d, tail_values);
                std::memcpy(destination[i] + k, tail_values, count * sizeof(float));
            }
        }
    }
    hwy::FlushStream();
}
#endif

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
