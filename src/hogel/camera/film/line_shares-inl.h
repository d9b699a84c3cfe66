// SPDX-License-Identifier: Apache-2.0
// Vector code of line_shares_plain(), compiled for every SIMD target. Include it after hwy/highway.h.
#if defined(HOGEL_OPTICS_FILM_LINE_SHARES) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_OPTICS_FILM_LINE_SHARES
#undef HOGEL_OPTICS_FILM_LINE_SHARES
#else
#define HOGEL_OPTICS_FILM_LINE_SHARES
#endif

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::film::HWY_NAMESPACE {

// Computes the shares of 2, 3 or 5 nodes in the weights of lines t.
template <std::size_t nodes, class D, class V>
HWY_INLINE void line_shares(D d, V t, V (&shares)[nodes]) {
    namespace hn = hwy::HWY_NAMESPACE;
    const auto set = [&](double value) HWY_ATTR { return hn::Set(d, static_cast<float>(value)); };
    const V one = set(1), low = hn::Sub(t, one), high = hn::Add(t, one);
    if constexpr (nodes == 2) {
        shares[0] = hn::Mul(low, set(-0.5));
        shares[1] = hn::Mul(high, set(0.5));
    } else if constexpr (nodes == 3) {
        shares[0] = hn::Mul(hn::Mul(t, low), set(0.5));
        shares[1] = hn::Mul(hn::Neg(low), high);
        shares[2] = hn::Mul(hn::Mul(t, high), set(0.5));
    } else {
        static_assert(nodes == 5);
        const V before = hn::Add(t, set(0.5)), after = hn::Sub(t, set(0.5));
        const V inner = hn::Mul(hn::Mul(before, after), t), outer = hn::Mul(hn::Mul(low, high), t);
        shares[0] = hn::Mul(hn::Mul(inner, low), set(2.0 / 3));
        shares[1] = hn::Mul(hn::Mul(outer, after), set(-8.0 / 3));
        shares[2] = hn::Mul(hn::Mul(hn::Mul(before, after), hn::Mul(low, high)), set(4));
        shares[3] = hn::Mul(hn::Mul(outer, before), set(-8.0 / 3));
        shares[4] = hn::Mul(hn::Mul(inner, high), set(2.0 / 3));
    }
}

template <class Use>
HWY_INLINE void with_nodes(std::size_t nodes, const Use& use) {
    if (nodes == 2)
        use(std::integral_constant<std::size_t, 2>());
    else if (nodes == 3)
        use(std::integral_constant<std::size_t, 3>());
    else
        use(std::integral_constant<std::size_t, 5>());
}

}  // namespace hogel::camera::film::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
