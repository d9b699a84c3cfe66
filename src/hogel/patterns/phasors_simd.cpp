// SPDX-License-Identifier: Apache-2.0
// The SIMD version of phasors.cpp, compiled for every SIMD target.
#include <cstddef>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/patterns/phasors.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::patterns::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
using Tag = hn::ScalableTag<float>;
using Vector = hn::Vec<Tag>;

// The angle of (re, im) in cycles, 0 to 1; 0 for (0, 0). The polynomial is a fit at Chebyshev's points of
// atan(t)/(2πt), in t², for 0 ≤ t ≤ 1.
HWY_INLINE Vector Cycles(Tag d, Vector re, Vector im) {
    const auto zero = hn::Zero(d), a = hn::Abs(re), b = hn::Abs(im);
    const auto larger = hn::Max(a, b);
    const auto t = hn::IfThenElseZero(hn::Gt(larger, zero), hn::Div(hn::Min(a, b), larger)), u = hn::Mul(t, t);
    auto p = hn::Set(d, 0.00045105536f);
    for (const float factor : {-0.0025472797f, 0.0067780283f, -0.011929372f, 0.01692892f, -0.022604093f, 0.031819027f,
                               -0.053051222f, 0.15915494f})
        p = hn::MulAdd(p, u, hn::Set(d, factor));
    p = hn::Mul(p, t);
    p = hn::IfThenElse(hn::Gt(b, a), hn::Sub(hn::Set(d, 0.25f), p), p);
    p = hn::IfThenElse(hn::Lt(re, zero), hn::Sub(hn::Set(d, 0.5f), p), p);
    return hn::IfThenElse(hn::Lt(im, zero), hn::Sub(hn::Set(d, 1.0f), p), p);
}
#endif

void PhasesOf(const std::complex<float>* field, std::span<float> cycles) {
    std::size_t x = 0;
#if HWY_TARGET != HWY_SCALAR
    const Tag d;
    const auto* from = reinterpret_cast<const float*>(field);
    for (const std::size_t lanes = hn::Lanes(d); x + lanes <= cycles.size(); x += lanes) {
        Vector re, im;
        hn::LoadInterleaved2(d, from + 2 * x, re, im);
        hn::StoreU(Cycles(d, re, im), d, cycles.data() + x);
    }
#endif
    if (x < cycles.size()) phases_of_plain(field + x, cycles.subspan(x));
}

// acos m is the angle of (m, √(1 − m²)).
void DoublePhases(const std::complex<float>* field, float first_sign, std::span<float> cycles) {
    std::size_t x = 0;
#if HWY_TARGET != HWY_SCALAR
    const Tag d;
    const auto* from = reinterpret_cast<const float*>(field);
    const auto one = hn::Set(d, 1.0f), sign = hn::OddEven(hn::Set(d, -first_sign), hn::Set(d, first_sign));
    for (const std::size_t lanes = hn::Lanes(d); x + lanes <= cycles.size(); x += lanes) {
        Vector re, im;
        hn::LoadInterleaved2(d, from + 2 * x, re, im);
        const auto m = hn::Min(one, hn::Sqrt(hn::MulAdd(re, re, hn::Mul(im, im))));
        const auto half_angle = Cycles(d, m, hn::Sqrt(hn::Mul(hn::Sub(one, m), hn::Add(one, m))));
        const auto phase = hn::MulAdd(sign, half_angle, Cycles(d, re, im));
        hn::StoreU(hn::Sub(phase, hn::Floor(phase)), d, cycles.data() + x);
    }
#endif
    if (x < cycles.size()) double_phases_plain(field + x, first_sign, cycles.subspan(x));
}

// With r = φ − qπ/2, |r| ≤ π/4, from the polynomials of Cephes' sinf and cosf. π/2 has three parts; q times the
// first two is exact.
void Phasors(const float* phases, std::span<std::complex<float>> out) {
    std::size_t x = 0;
#if HWY_TARGET != HWY_SCALAR
    const Tag d;
    const hn::RebindToSigned<Tag> di;
    auto* to = reinterpret_cast<float*>(out.data());
    const auto one = hn::Set(di, 1), two = hn::Set(di, 2);
    for (const std::size_t lanes = hn::Lanes(d); x + lanes <= out.size(); x += lanes) {
        const auto phase = hn::LoadU(d, phases + x);
        const auto turns = hn::Round(hn::Mul(phase, hn::Set(d, 0.63661977f)));
        auto r = hn::NegMulAdd(turns, hn::Set(d, 1.5703125f), phase);
        r = hn::NegMulAdd(turns, hn::Set(d, 4.837512969970703125e-4f), r);
        r = hn::NegMulAdd(turns, hn::Set(d, 7.54978995489188216e-8f), r);
        const auto u = hn::Mul(r, r);
        auto s = hn::MulAdd(hn::Set(d, -1.9515295891e-4f), u, hn::Set(d, 8.3321608736e-3f));
        s = hn::MulAdd(s, u, hn::Set(d, -1.6666654611e-1f));
        s = hn::MulAdd(hn::Mul(s, u), r, r);
        auto c = hn::MulAdd(hn::Set(d, 2.443315711809948e-5f), u, hn::Set(d, -1.388731625493765e-3f));
        c = hn::MulAdd(c, u, hn::Set(d, 4.166664568298827e-2f));
        c = hn::MulAdd(hn::Mul(c, u), u, hn::NegMulAdd(u, hn::Set(d, 0.5f), hn::Set(d, 1.0f)));
        const auto q = hn::ConvertTo(di, turns);
        const auto is_odd = hn::RebindMask(d, hn::Eq(hn::And(q, one), one));
        const auto sine_sign = hn::BitCast(d, hn::ShiftLeft<30>(hn::And(q, two)));
        const auto cosine_sign = hn::BitCast(d, hn::ShiftLeft<30>(hn::And(hn::Add(q, one), two)));
        const auto re = hn::Xor(hn::IfThenElse(is_odd, s, c), cosine_sign);
        const auto im = hn::Xor(hn::IfThenElse(is_odd, c, s), sine_sign);
        hn::StoreInterleaved2(re, im, d, to + 2 * x);
    }
#endif
    if (x < out.size()) phasors_plain(phases + x, out.subspan(x));
}

void SetModuli(const float* moduli, std::span<std::complex<float>> values) {
    std::size_t x = 0;
#if HWY_TARGET != HWY_SCALAR
    const Tag d;
    auto* at = reinterpret_cast<float*>(values.data());
    for (const std::size_t lanes = hn::Lanes(d); x + lanes <= values.size(); x += lanes) {
        Vector re, im;
        hn::LoadInterleaved2(d, at + 2 * x, re, im);
        const auto m = hn::LoadU(d, moduli + x), norm = hn::MulAdd(re, re, hn::Mul(im, im));
        const auto is_dark = hn::Eq(norm, hn::Zero(d));
        const auto factor = hn::Div(m, hn::Sqrt(hn::IfThenElse(is_dark, hn::Set(d, 1.0f), norm)));
        hn::StoreInterleaved2(hn::IfThenElse(is_dark, m, hn::Mul(re, factor)),
                              hn::IfThenZeroElse(is_dark, hn::Mul(im, factor)), d, at + 2 * x);
    }
#endif
    if (x < values.size()) set_moduli_plain(moduli + x, values.subspan(x));
}

}  // namespace hogel::patterns::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::patterns {
HOGEL_DISPATCH(phases_of, PhasesOf);
HOGEL_DISPATCH(double_phases, DoublePhases);
HOGEL_DISPATCH(phasors, Phasors);
HOGEL_DISPATCH(set_moduli, SetModuli);
}  // namespace hogel::patterns
