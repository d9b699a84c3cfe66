// SPDX-License-Identifier: Apache-2.0
// What epi_shade_simd.cpp and epi_light_simd.cpp do with vectors of samples; included after hwy/highway.h, once for
// every instruction set.
#if defined(HOGEL_RENDER_EPI_SAMPLES) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_RENDER_EPI_SAMPLES
#undef HOGEL_RENDER_EPI_SAMPLES
#else
#define HOGEL_RENDER_EPI_SAMPLES
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/lane_bits.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A single lane holds no four values.
#if HWY_TARGET != HWY_SCALAR
#if HWY_HAVE_SCALABLE
using FloatTag = hn::FixedTag<float, 4>;
#else
using FloatTag = hn::ScalableTag<float>;
#endif
using NumberTag = hn::RebindToUnsigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Numbers = hn::Vec<NumberTag>;

// Four floats at place(0), place(4), …, one after the other.
template <class Place>
HWY_INLINE Floats load_blocks(const Place& place) {
    const FloatTag d;
    constexpr std::size_t lanes = hn::MaxLanes(d);
    const auto in_all_blocks = [&](std::size_t i) HWY_ATTR { return hn::LoadDup128(d, place(i)); };
    if constexpr (lanes == 4)
        return in_all_blocks(0);
    else if constexpr (lanes == 8)
        return hn::OddEvenBlocks(in_all_blocks(4), in_all_blocks(0));
    else {
        // Half by half: g++ 12 fails inside on blends of blocks that are already in a register.
        const hn::Half<FloatTag> dh;
        const auto half = [&](std::size_t i) HWY_ATTR {
            return hn::OddEvenBlocks(hn::LoadDup128(dh, place(i + 4)), hn::LoadDup128(dh, place(i)));
        };
        return hn::Combine(d, half(8), half(0));
    }
}

// Four floats so far behind each fourth of these places.
HWY_INLINE Floats load_blocks(const float* const* places, std::size_t behind) {
    return load_blocks([=](std::size_t i) { return places[i] + behind; });
}

// Four vectors, whose block b holds four floats of sample 4 b + i, become those floats of all samples: and back.
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

// As part_of_strip.
HWY_INLINE Floats parts_of_strips(Floats n, Floats K, const Floats (&place)[4]) {
    const FloatTag d;
    const auto& [x0, z0, dx, dz] = place;
    const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const Floats part = hn::Div(hn::Add(hn::Sub(n, x0), hn::Mul(K, z0)), hn::Sub(dx, hn::Mul(K, dz)));
    const Floats positive = hn::IfThenElse(hn::Gt(part, zero), part, zero);
    return hn::IfThenElse(hn::Lt(positive, one), positive, one);
}

// Of samples that all show one strip.
HWY_INLINE Floats parts_of_one(const StripShades& strip, Floats n, Floats K) {
    const FloatTag d;
    return parts_of_strips(n, K,
                           {hn::Set(d, strip.x0), hn::Set(d, strip.z0), hn::Set(d, strip.dx), hn::Set(d, strip.dz)});
}

// The numbers of a vector of words.
HWY_INLINE Numbers numbers_of(const std::uint64_t* words) {
    const NumberTag du;
    const hn::RepartitionToWide<NumberTag> d64;
    return hn::ConcatEven(du, hn::BitCast(du, hn::LoadU(d64, words + hn::Lanes(d64))),
                          hn::BitCast(du, hn::LoadU(d64, words)));
}

// Turns all words of a plane into values and empties it. `shade_vector` takes the words of a vector of samples, of
// which those beyond the plane show nothing, and their column and the first of their directions, and gives their
// values. If it has a function `begin`, that is told of each column before.
template <class ShadeVector>
HWY_INLINE void shade_vectors(const EpipolarPlane& plane, const ShadedPlane& out, const ShadeVector& shade_vector) {
    const FloatTag d;
    const hn::RepartitionToWide<NumberTag> d64;
    const std::size_t lanes = hn::Lanes(d), directions = plane.directions;
    const bool aligned = out.begins_at_multiples(lanes);
    const auto nothing = hn::Set(d64, EpipolarPlane::nothing);
    for (std::size_t column = 0; column < plane.columns; ++column) {
        std::uint64_t* words = plane.words + column * directions;
        float* to[4];
        for (int i = 0; i < 4; ++i) to[i] = out.values[i] ? out.values[i] + column * out.strides[i] : nullptr;
        if constexpr (requires { shade_vector.begin(column); }) shade_vector.begin(column);
        std::size_t k = 0;
        for (; aligned && k + lanes <= directions; k += lanes, words += lanes) {
            Floats values[4];
            shade_vector(words, column, k, values);
            hn::StoreU(nothing, d64, words);
            hn::StoreU(nothing, d64, words + lanes / 2);
            // Past the caches: nobody reads a sample soon after.
            if (to[0]) hn::Stream(values[0], d, to[0] + k);
            if (to[1]) hn::Stream(values[1], d, to[1] + k);
            if (to[2]) hn::Stream(values[2], d, to[2] + k);
            if (to[3]) hn::Stream(values[3], d, to[3] + k);
        }
        for (; k < directions; k += lanes, words += lanes) {
            const std::size_t count = std::min(lanes, directions - k);
            HWY_ALIGN std::uint64_t some_words[hn::MaxLanes(d)] = {};
            std::copy_n(words, count, some_words);
            std::fill_n(words, count, EpipolarPlane::nothing);
            Floats values[4];
            shade_vector(some_words, column, k, values);
            for (int i = 0; i < 4; ++i) {
                if (!to[i]) continue;
                HWY_ALIGN float some[hn::MaxLanes(d)];
                hn::Store(values[i], d, some);
                std::memcpy(to[i] + k, some, count * sizeof(float));
            }
        }
    }
    hwy::FlushStream();
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::render::epi
HWY_AFTER_NAMESPACE();
#endif
