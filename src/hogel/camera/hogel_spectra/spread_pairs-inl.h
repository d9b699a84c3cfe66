// SPDX-License-Identifier: Apache-2.0
// Vector code of sums over the functions of a basis at its nodes, times a carrier, for files that are compiled for
// every SIMD target. Include it after hwy/highway.h.
#if defined(HOGEL_HOLOGRAM_EYE_SPREAD_PAIRS) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_HOLOGRAM_EYE_SPREAD_PAIRS
#undef HOGEL_HOLOGRAM_EYE_SPREAD_PAIRS
#else
#define HOGEL_HOLOGRAM_EYE_SPREAD_PAIRS
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "hogel/camera/hogel_spectra/slepian_basis.h"
#include "hogel/core/with_count.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::hogel_spectra::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
// Adds (re + i im) (c + is) to the parts of a vector of numbers.
template <class V>
HWY_INLINE void add_product(V re, V im, V c, V s, float* real, float* imaginary) {
    const hn::DFromV<V> d;
    hn::StoreU(hn::NegMulAdd(im, s, hn::MulAdd(re, c, hn::LoadU(d, real))), d, real);
    hn::StoreU(hn::MulAdd(im, c, hn::MulAdd(re, s, hn::LoadU(d, imaginary))), d, imaginary);
}

// Pairs of nodes with sums in registers; more fit into 32 registers.
constexpr std::size_t pairs_per_batch = HWY_ARCH_X86 && HWY_TARGET > HWY_AVX3 ? 2 : 4;

// Sums over functions for `pairs` pairs of nodes from `first` on. Two nodes at the same distance from the middle have
// equal even functions and opposite odd ones. The two parts of a function are adjacent rows, `stride` floats apart.
// Calls store(pair, even re, even im, odd re, odd im) with a vector each.
template <std::size_t pairs, class Store>
HWY_INLINE void spread_batch(const SlepianBasis& basis, std::size_t first, const float* in, std::size_t stride,
                             const Store& store) {
    const hn::CappedTag<float, lanes> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t functions = basis.functions();
    const float* spread = basis.spread().data() + first * functions;
    V sums[2][pairs][2];  // [odd][pair][part]
    for (auto& parity : sums)
        for (auto& sum : parity) sum[0] = sum[1] = hn::Zero(d);
    const auto add = [&](std::size_t k, V(&to)[pairs][2]) HWY_ATTR {
        const V re = hn::Load(d, in + 2 * k * stride), im = hn::Load(d, in + (2 * k + 1) * stride);
        for (std::size_t p = 0; p < pairs; ++p) {
            const V weight = hn::Set(d, spread[p * functions + k]);
            to[p][0] = hn::MulAdd(weight, re, to[p][0]);
            to[p][1] = hn::MulAdd(weight, im, to[p][1]);
        }
    };
    for (std::size_t k = 0; k + 1 < functions; k += 2) {
        add(k, sums[0]);
        add(k + 1, sums[1]);
    }
    if (functions % 2 != 0) add(functions - 1, sums[0]);
    for (std::size_t p = 0; p < pairs; ++p)
        store(first + p, sums[0][p][0], sums[0][p][1], sums[1][p][0], sums[1][p][1]);
}

// Does the same for all pairs of nodes. A node in the middle is its own partner.
template <class Store>
HWY_INLINE void spread_pairs(const SlepianBasis& basis, const float* in, std::size_t stride, const Store& store) {
    const std::size_t pairs = (basis.nodes() + 1) / 2;
    for (std::size_t first = 0; first < pairs; first += pairs_per_batch)
        core::HWY_NAMESPACE::with_count<pairs_per_batch>(
            std::min(pairs_per_batch, pairs - first),
            [&](auto fixed_count) HWY_ATTR { spread_batch<fixed_count()>(basis, first, in, stride, store); });
}
#endif

}  // namespace hogel::camera::hogel_spectra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
