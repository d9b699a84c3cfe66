// SPDX-License-Identifier: Apache-2.0
// Small transforms in registers, for the SIMD target that is being compiled.
#if defined(HOGEL_MATH_FOURIER_BUTTERFLIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_MATH_FOURIER_BUTTERFLIES_INL_H
#undef HOGEL_MATH_FOURIER_BUTTERFLIES_INL_H
#else
#define HOGEL_MATH_FOURIER_BUTTERFLIES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>

#include "hogel/math/fourier/plan.h"
#include "hogel/math/numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::math::fourier::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
using math::HWY_NAMESPACE::D;
using math::HWY_NAMESPACE::InSplit;
using math::HWY_NAMESPACE::Interleaved;
using math::HWY_NAMESPACE::MinusTurned;
using math::HWY_NAMESPACE::Numbers;
using math::HWY_NAMESPACE::PlusTurned;
using math::HWY_NAMESPACE::Times;
using math::HWY_NAMESPACE::V;
static_assert(batch_lines == ColumnFft::batch_columns);

// cos and sin of 2πk/radix for k from 1 to (radix − 1)/2.
template <std::size_t radix>
struct Roots;
template <>
struct Roots<3> {
    static constexpr float cosines[] = {-0.5f}, sines[] = {0.866025403784438646764f};
};
template <>
struct Roots<5> {
    static constexpr float cosines[] = {0.309016994374947424102f, -0.809016994374947424102f},
                           sines[] = {0.951056516295153572116f, 0.587785252292473129169f};
};
template <>
struct Roots<7> {
    static constexpr float cosines[] = {0.623489801858733530525f, -0.222520933956314404289f, -0.900968867902419126236f},
                           sines[] = {0.781831482468029808708f, 0.974927912181823607018f, 0.433883739117558120475f};
};
template <>
struct Roots<11> {
    static constexpr float cosines[] = {0.841253532831181168861f, 0.415415013001886425529f, -0.142314838273285140444f,
                                        -0.654860733945285064056f, -0.959492973614497389890f},
                           sines[] = {0.540640817455597582107f, 0.909631995354518371411f, 0.989821441880932732376f,
                                      0.755749574354258283774f, 0.281732556841429697711f};
};
template <>
struct Roots<13> {
    static constexpr float cosines[] = {0.885456025653209896157f,  0.568064746731155810250f,
                                        0.120536680255323000290f,  -0.354604887042535625969f,
                                        -0.748510748171101098634f, -0.970941817426052027156f},
                           sines[] = {0.464723172043768546178f, 0.822983865893656434583f, 0.992708874098054044044f,
                                      0.935016242685414802313f, 0.663122658240795212018f, 0.239315664287557711128f};
};

// y_k = Σ_i x_i w^{ik}, in place. With s_i = x_i + x_{r−i} and d_i = x_i − x_{r−i} for i from 1 to h = (r−1)/2,
//   y_k and y_{r−k} = x_0 + Σ_i cos(2πik/r) s_i  ∓ i Σ_i sin(2πik/r) d_i.
template <std::size_t radix>
struct Butterfly {
    static HWY_INLINE void Run(D d, Numbers* HWY_RESTRICT x) {
        constexpr std::size_t half = (radix - 1) / 2;
        Numbers sums[half], differences[half];
        Numbers total = x[0];
#pragma GCC unroll 16
        for (std::size_t i = 0; i < half; ++i) {
            sums[i] = x[i + 1] + x[radix - 1 - i];
            differences[i] = x[i + 1] - x[radix - 1 - i];
            total = total + sums[i];
        }
#pragma GCC unroll 16
        for (std::size_t k = 1; k <= half; ++k) {
            Numbers even = x[0], odd;
#pragma GCC unroll 16
            for (std::size_t i = 0; i < half; ++i) {
                const std::size_t multiple = k * (i + 1) % radix;
                const bool mirrored = multiple > half;
                const std::size_t root = (mirrored ? radix - multiple : multiple) - 1;
                const V cosine = hn::Set(d, Roots<radix>::cosines[root]);
                const V sine = hn::Set(d, mirrored ? -Roots<radix>::sines[root] : Roots<radix>::sines[root]);
                even = {hn::MulAdd(sums[i].re, cosine, even.re), hn::MulAdd(sums[i].im, cosine, even.im)};
                if (i == 0)
                    odd = {hn::Mul(differences[i].re, sine), hn::Mul(differences[i].im, sine)};
                else
                    odd = {hn::MulAdd(differences[i].re, sine, odd.re), hn::MulAdd(differences[i].im, sine, odd.im)};
            }
            x[k] = MinusTurned(even, odd);
            x[radix - k] = PlusTurned(even, odd);
        }
        x[0] = total;
    }
};

template <>
struct Butterfly<2> {
    static HWY_INLINE void Run(D, Numbers* HWY_RESTRICT x) {
        const Numbers a = x[0], b = x[1];
        x[0] = a + b;
        x[1] = a - b;
    }
};

HWY_INLINE void Four(Numbers& a, Numbers& b, Numbers& c, Numbers& e) {
    const Numbers sum_ac = a + c, difference_ac = a - c, sum_be = b + e, difference_be = b - e;
    a = sum_ac + sum_be;
    b = MinusTurned(difference_ac, difference_be);
    c = sum_ac - sum_be;
    e = PlusTurned(difference_ac, difference_be);
}

template <>
struct Butterfly<4> {
    static HWY_INLINE void Run(D, Numbers* HWY_RESTRICT x) { Four(x[0], x[1], x[2], x[3]); }
};

template <>
struct Butterfly<8> {
    static HWY_INLINE void Run(D d, Numbers* HWY_RESTRICT x) {
        const V r = hn::Set(d, 0.707106781186547524401f);
        Numbers a0 = x[0] + x[4], a1 = x[1] + x[5], a2 = x[2] + x[6], a3 = x[3] + x[7];
        Numbers b0 = x[0] - x[4], b1 = x[1] - x[5], b2 = x[2] - x[6], b3 = x[3] - x[7];
        // b_k w_8^k with w_8 = (1 − i)/√2
        b1 = {hn::Mul(hn::Add(b1.re, b1.im), r), hn::Mul(hn::Sub(b1.im, b1.re), r)};
        b2 = {b2.im, hn::Neg(b2.re)};
        b3 = {hn::Mul(hn::Sub(b3.im, b3.re), r), hn::Neg(hn::Mul(hn::Add(b3.re, b3.im), r))};
        Four(a0, a1, a2, a3);
        Four(b0, b1, b2, b3);
        x[0] = a0, x[2] = a1, x[4] = a2, x[6] = a3;
        x[1] = b0, x[3] = b1, x[5] = b2, x[7] = b3;
    }
};

// Interleaved layout with real and imaginary parts exchanged.
struct Exchanged {
    static HWY_INLINE Numbers Load(D d, const float* row, std::size_t i) {
        Numbers x;
        hn::LoadInterleaved2(d, row + 2 * i, x.im, x.re);
        return x;
    }
    static HWY_INLINE void Store(D d, const Numbers& x, float* row, std::size_t i) {
        hn::StoreInterleaved2(x.im, x.re, d, row + 2 * i);
    }
};

// Loads 128 bits at `offset` from every fourth line: lines[0], lines[4], …
template <class Tag>
HWY_INLINE hn::Vec<Tag> LoadParts(Tag d, const float* const* lines, std::size_t offset) {
    if constexpr (hn::MaxLanes(d) == 4) {
        return hn::LoadU(d, lines[0] + offset);
    } else {
        const hn::Half<Tag> half;
        return hn::Combine(d, LoadParts(half, lines + hn::MaxLanes(half), offset), LoadParts(half, lines, offset));
    }
}
template <class Tag>
HWY_INLINE void StoreParts(Tag d, hn::Vec<Tag> x, float* const* lines, std::size_t offset) {
    if constexpr (hn::MaxLanes(d) == 4) {
        hn::StoreU(x, d, lines[0] + offset);
    } else {
        const hn::Half<Tag> half;
        StoreParts(half, hn::LowerHalf(half, x), lines, offset);
        StoreParts(half, hn::UpperHalf(half, x), lines + hn::MaxLanes(half), offset);
    }
}
// Transposes two complex numbers from as many lines as a vector has lanes to two vectors of complex numbers.
HWY_INLINE void TransposePair(D d, const float* const* lines, std::size_t offset, Numbers& first, Numbers& second) {
    const V a = LoadParts(d, lines, offset), b = LoadParts(d, lines + 1, offset), c = LoadParts(d, lines + 2, offset),
            e = LoadParts(d, lines + 3, offset);
    const V ac0 = hn::InterleaveLower(d, a, c), be0 = hn::InterleaveLower(d, b, e), ac1 = hn::InterleaveUpper(d, a, c),
            be1 = hn::InterleaveUpper(d, b, e);
    first = {hn::InterleaveLower(d, ac0, be0), hn::InterleaveUpper(d, ac0, be0)};
    second = {hn::InterleaveLower(d, ac1, be1), hn::InterleaveUpper(d, ac1, be1)};
}
// Interleave the lower, or upper, 64 bits of each 128-bit part of a and b.
HWY_INLINE V LowerPairs(D d, V a, V b) {
    const hn::Repartition<double, D> pairs;
    return hn::BitCast(d, hn::InterleaveLower(pairs, hn::BitCast(pairs, a), hn::BitCast(pairs, b)));
}
HWY_INLINE V UpperPairs(D d, V a, V b) {
    const hn::Repartition<double, D> pairs;
    return hn::BitCast(d, hn::InterleaveUpper(pairs, hn::BitCast(pairs, a), hn::BitCast(pairs, b)));
}
// Inverse of TransposePair().
HWY_INLINE void TransposePairBack(D d, const Numbers& first, const Numbers& second, float* const* lines,
                                  std::size_t offset) {
    const V ab0 = hn::InterleaveLower(d, first.re, first.im), ab1 = hn::InterleaveLower(d, second.re, second.im),
            ce0 = hn::InterleaveUpper(d, first.re, first.im), ce1 = hn::InterleaveUpper(d, second.re, second.im);
    StoreParts(d, LowerPairs(d, ab0, ab1), lines, offset);
    StoreParts(d, UpperPairs(d, ab0, ab1), lines + 1, offset);
    StoreParts(d, LowerPairs(d, ce0, ce1), lines + 2, offset);
    StoreParts(d, UpperPairs(d, ce0, ce1), lines + 3, offset);
}
HWY_INLINE Numbers ExchangedIf(bool exchange, const Numbers& x) { return exchange ? Numbers{x.im, x.re} : x; }
// Transposes four rows of four floats.
HWY_INLINE void TransposeFour(const float* const* rows, std::size_t offset, float* out, std::size_t out_row) {
    const hn::FixedTag<float, 4> d;
    const auto a = hn::Load(d, rows[0] + offset), b = hn::Load(d, rows[1] + offset), c = hn::Load(d, rows[2] + offset),
               e = hn::Load(d, rows[3] + offset);
    const auto ac0 = hn::InterleaveLower(d, a, c), be0 = hn::InterleaveLower(d, b, e),
               ac1 = hn::InterleaveUpper(d, a, c), be1 = hn::InterleaveUpper(d, b, e);
    hn::Store(hn::InterleaveLower(d, ac0, be0), d, out);
    hn::Store(hn::InterleaveUpper(d, ac0, be0), d, out + out_row);
    hn::Store(hn::InterleaveLower(d, ac1, be1), d, out + 2 * out_row);
    hn::Store(hn::InterleaveUpper(d, ac1, be1), d, out + 3 * out_row);
}
#endif

}  // namespace hogel::math::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
