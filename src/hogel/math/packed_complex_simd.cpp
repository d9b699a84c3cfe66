// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/simd_targets-inl.h"
#include "hogel/math/packed_complex-inl.h"
#include "hogel/math/packed_complex.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::math::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using Complex = std::complex<float>;

void Pack(const Complex* from, PackedComplex* to, std::size_t n) {
    std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
    const hn::ScalableTag<float> d;
    for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d)) {
        hn::Vec<decltype(d)> re, im;
        hn::LoadInterleaved2(d, reinterpret_cast<const float*>(from + i), re, im);
        hn::StoreU(pack(d, re, im), hn::RebindToUnsigned<decltype(d)>(), &to[i].bits);
    }
#endif
    for (; i < n; ++i) to[i] = math::pack(from[i]);
}

}  // namespace hogel::math::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::math {

HWY_EXPORT(Pack);

void pack(const std::complex<float>* from, PackedComplex* to, std::size_t n) {
    HWY_DYNAMIC_DISPATCH(Pack)(from, to, n);
}

}  // namespace hogel::math
#endif
