// SPDX-License-Identifier: Apache-2.0
// Vectors of complex numbers and their memory layouts, for the SIMD target that is being compiled.
#if defined(HOGEL_MATH_NUMBERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_MATH_NUMBERS_INL_H
#undef HOGEL_MATH_NUMBERS_INL_H
#else
#define HOGEL_MATH_NUMBERS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "hogel/math/column_fft.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::math::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
using D = hn::CappedTag<float, ColumnFft::batch_columns>;
using V = hn::Vec<D>;

// A vector of complex numbers with separate real and imaginary parts.
struct Numbers {
    V re, im;
};

HWY_INLINE Numbers operator+(const Numbers& a, const Numbers& b) { return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)}; }
HWY_INLINE Numbers operator-(const Numbers& a, const Numbers& b) { return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)}; }
HWY_INLINE Numbers Times(const Numbers& x, V re, V im) {
    return {hn::NegMulAdd(x.im, im, hn::Mul(x.re, re)), hn::MulAdd(x.im, re, hn::Mul(x.re, im))};
}
// a − ib and a + ib
HWY_INLINE Numbers MinusTurned(const Numbers& a, const Numbers& b) {
    return {hn::Add(a.re, b.im), hn::Sub(a.im, b.re)};
}
HWY_INLINE Numbers PlusTurned(const Numbers& a, const Numbers& b) { return {hn::Sub(a.re, b.im), hn::Add(a.im, b.re)}; }

// Row layouts: Interleaved alternates real and imaginary parts; InSplit has sixteen real parts, then sixteen imaginary.
struct Interleaved {
    static HWY_INLINE Numbers Load(D d, const float* row, std::size_t i) {
        Numbers x;
        hn::LoadInterleaved2(d, row + 2 * i, x.re, x.im);
        return x;
    }
    static HWY_INLINE void Store(D d, const Numbers& x, float* row, std::size_t i) {
        hn::StoreInterleaved2(x.re, x.im, d, row + 2 * i);
    }
};
struct InSplit {
    static HWY_INLINE Numbers Load(D d, const float* row, std::size_t i) {
        return {hn::Load(d, row + i), hn::Load(d, row + ColumnFft::batch_columns + i)};
    }
    static HWY_INLINE void Store(D d, const Numbers& x, float* row, std::size_t i) {
        hn::Store(x.re, d, row + i);
        hn::Store(x.im, d, row + ColumnFft::batch_columns + i);
    }
};
#endif

}  // namespace hogel::math::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
