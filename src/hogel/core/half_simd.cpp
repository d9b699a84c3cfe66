// SPDX-License-Identifier: Apache-2.0
// Compiled for every SIMD target. Uses the processor's conversions (F16C) with AVX2 and later, otherwise branch-free
// loops of half_of() and float_of().
#include "hogel/core/half.h"
#include "hogel/core/simd_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::core::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void ToHalf(const float* from, std::uint16_t* to, std::size_t n) {
    std::size_t i = 0;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
    const hn::ScalableTag<float> d;
    const hn::Rebind<hwy::float16_t, decltype(d)> halves;
    for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d))
        hn::StoreU(hn::DemoteTo(halves, hn::LoadU(d, from + i)), halves, reinterpret_cast<hwy::float16_t*>(to + i));
#endif
    for (; i < n; ++i) to[i] = half_of(from[i]);
}

// A half is infinite or NaN if all bits of its exponent are set. Adding 1 to the exponent then carries into the sign
// bit. The carries of all values are ORed.
bool ToFloat(const std::uint16_t* from, float* to, std::size_t n) {
    std::size_t i = 0;
    bool finite = true;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
    const hn::ScalableTag<float> d;
    const hn::Rebind<hwy::float16_t, decltype(d)> halves;
    const hn::Rebind<std::uint16_t, decltype(d)> bits;
    auto carries = hn::Zero(bits);
    for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d)) {
        const auto half = hn::LoadU(bits, from + i);
        carries = hn::Or(carries, hn::Add(hn::And(half, hn::Set(bits, 0x7fff)), hn::Set(bits, 0x0400)));
        hn::StoreU(hn::PromoteTo(d, hn::BitCast(halves, half)), d, to + i);
    }
    finite = hn::AllTrue(bits, hn::Eq(hn::And(carries, hn::Set(bits, 0x8000)), hn::Zero(bits)));
#endif
    std::uint16_t tail_carries = 0;
    for (; i < n; ++i) {
        tail_carries = static_cast<std::uint16_t>(tail_carries | ((from[i] & 0x7fff) + 0x0400));
        to[i] = float_of(from[i]);
    }
    return finite && (tail_carries & 0x8000) == 0;
}

}  // namespace hogel::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::core {
HOGEL_DISPATCH(to_half, ToHalf);
HOGEL_DISPATCH(to_float, ToFloat);
}  // namespace hogel::core
