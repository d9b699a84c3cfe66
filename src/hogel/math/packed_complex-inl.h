// SPDX-License-Identifier: Apache-2.0
// pack() and unpack() of vectors, for files that are compiled once per SIMD target. Include it after hwy/highway.h.
#if defined(HOGEL_MATH_PACKED_COMPLEX) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_MATH_PACKED_COMPLEX
#undef HOGEL_MATH_PACKED_COMPLEX
#else
#define HOGEL_MATH_PACKED_COMPLEX
#endif

#include <hwy/highway.h>

#include "hogel/math/packed_complex.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::math::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR
/// @param d  tag of the real and imaginary parts, floats
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::RebindToUnsigned<D>> pack(D d, V re, V im) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::RebindToUnsigned<D> words;
    const auto larger = hn::BitCast(words, hn::Max(hn::Abs(re), hn::Abs(im)));
    const auto shift = hn::Set(words, packed_shift);
    const auto exponent = hn::Max(hn::ShiftRight<23>(hn::Add(larger, hn::Set(words, 1u << 12))), shift);
    const auto scale = hn::BitCast(d, hn::ShiftLeft<23>(hn::Sub(hn::Set(words, 2 * 127 + packed_shift), exponent)));
    // Adding 1.5 · 2^23 rounds to an integer in the low bits.
    const auto large = hn::Set(d, 0x1.8p23f);
    const auto a = hn::BitCast(words, hn::MulAdd(re, scale, large)),
               b = hn::BitCast(words, hn::MulAdd(im, scale, large));
    return hn::Or3(hn::ShiftLeft<20>(a), hn::ShiftRight<12>(hn::ShiftLeft<20>(b)), hn::Sub(exponent, shift));
}

template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE void unpack(D d, hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::RebindToUnsigned<D>> words, V& re, V& im) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::RebindToSigned<D> integers;
    const auto scale = hn::BitCast(d, hn::ShiftLeft<23>(hn::And(words, hn::Set(hn::RebindToUnsigned<D>(), 0xff))));
    const auto part = [&](auto bits) HWY_ATTR {
        return hn::Mul(scale, hn::ConvertTo(d, hn::ShiftRight<20>(hn::BitCast(integers, bits))));
    };
    re = part(words);
    im = part(hn::ShiftLeft<12>(words));
}

/// Adds complex numbers to packed numbers.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE void add_to_packed(D d, V re, V im, PackedComplex* to) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::RebindToUnsigned<D> words;
    auto* bits = reinterpret_cast<std::uint32_t*>(to);
    V old_re, old_im;
    unpack(d, hn::LoadU(words, bits), old_re, old_im);
    hn::StoreU(pack(d, hn::Add(old_re, re), hn::Add(old_im, im)), words, bits);
}
#endif

}  // namespace hogel::math::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
