// SPDX-License-Identifier: Apache-2.0
// Vector code of e^{2πi cycles}, for files that are compiled for every SIMD target. Include it after hwy/highway.h.
#if defined(HOGEL_OPTICS_UNIT_PHASORS) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_OPTICS_UNIT_PHASORS
#undef HOGEL_OPTICS_UNIT_PHASORS
#else
#define HOGEL_OPTICS_UNIT_PHASORS
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR
// Computes e^{2πi cycles} for −1/2 … 1/2 cycles.
template <class F>
HWY_INLINE void unit_phasors_within(F cycles, F& cosine, F& sine) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::DFromV<F> df;
    // Half of the angle, −π/2 … π/2, by the Taylor series of sine and cosine, then doubled.
    const auto half = hn::Mul(cycles, hn::Set(df, 3.14159265f));
    const auto square = hn::Mul(half, half);
    auto s = hn::Set(df, -1.0f / 39916800), c = hn::Set(df, 1.0f / 479001600);
    for (float term : {1.0f / 362880, -1.0f / 5040, 1.0f / 120, -1.0f / 6, 1.0f})
        s = hn::MulAdd(s, square, hn::Set(df, term));
    for (float term : {-1.0f / 3628800, 1.0f / 40320, -1.0f / 720, 1.0f / 24, -0.5f, 1.0f})
        c = hn::MulAdd(c, square, hn::Set(df, term));
    s = hn::Mul(s, half);
    const auto twice = hn::Add(s, s);
    cosine = hn::NegMulAdd(twice, s, hn::Set(df, 1.0f));
    sine = hn::Mul(twice, c);
}

// Computes e^{2πi cycles} for any number of cycles in double precision, to single precision.
template <class DD, class F>
HWY_INLINE void unit_phasors(DD, hwy::HWY_NAMESPACE::Vec<DD> cycles, F& cosine, F& sine) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::Rebind<float, DD> df;
    unit_phasors_within(hn::DemoteTo(df, hn::Sub(cycles, hn::Round(cycles))), cosine, sine);
}
#endif

}  // namespace hogel::camera::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
