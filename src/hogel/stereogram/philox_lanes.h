// SPDX-License-Identifier: Apache-2.0
// Philox (core/random.h) with one draw per lane, for SIMD targets. Include it after hwy/highway.h.
#if defined(HOGEL_HOLOGRAM_PHILOX_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_HOLOGRAM_PHILOX_LANES
#undef HOGEL_HOLOGRAM_PHILOX_LANES
#else
#define HOGEL_HOLOGRAM_PHILOX_LANES
#endif

#include <hwy/highway.h>

#include <array>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace hogel::stereogram::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR
// Turns the four counter words into the words of the draw, in the lower halves of 64-bit lanes. The upper halves are
// arbitrary before and after, because products use lower halves only.
template <class D, class V>
HWY_INLINE void philox_lanes(D d, V& c0, V& c1, V& c2, V& c3, const std::array<std::uint32_t, 2>& key) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::Repartition<std::uint32_t, D> halves;
    const auto times = [&](V value, V factor) {
        return hn::MulEven(hn::BitCast(halves, value), hn::BitCast(halves, factor));
    };
    const V a = hn::Set(d, 0xD2511F53u), b = hn::Set(d, 0xCD9E8D57u);
    std::uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < 10; ++round, k0 += 0x9E3779B9u, k1 += 0xBB67AE85u) {
        const V p = times(c0, a), q = times(c2, b);
        c0 = hn::Xor(hn::Xor(hn::ShiftRight<32>(q), c1), hn::Set(d, k0));
        c2 = hn::Xor(hn::Xor(hn::ShiftRight<32>(p), c3), hn::Set(d, k1));
        c1 = q;
        c3 = p;
    }
}
#endif

}  // namespace hogel::stereogram::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
