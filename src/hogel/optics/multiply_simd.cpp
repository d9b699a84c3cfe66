// SPDX-License-Identifier: Apache-2.0
// The SIMD version of multiply.cpp, compiled for every SIMD target.
#include <cstddef>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/optics/multiply.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::optics::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void Multiply(const std::complex<float>* a, const std::complex<float>* b, std::span<std::complex<float>> out) {
    std::size_t x = 0;
#if HWY_TARGET != HWY_SCALAR  // a vector of one lane cannot hold a complex number
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d), floats = 2 * out.size();
    const auto *p = reinterpret_cast<const float*>(a), *q = reinterpret_cast<const float*>(b);
    auto* to = reinterpret_cast<float*>(out.data());
    const auto sign = hn::OddEven(hn::Set(d, 1.0f), hn::Set(d, -1.0f));
    for (; x + lanes <= floats; x += lanes) {
        const auto u = hn::LoadU(d, p + x), v = hn::LoadU(d, q + x);
        const auto imaginary = hn::Shuffle2301(hn::Mul(u, hn::DupOdd(v)));
        hn::StoreU(hn::MulAdd(sign, imaginary, hn::Mul(u, hn::DupEven(v))), d, to + x);
    }
#endif
    if (x < 2 * out.size()) multiply_plain(a + x / 2, b + x / 2, out.subspan(x / 2));
}

}  // namespace hogel::optics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::optics {
HOGEL_DISPATCH(multiply, Multiply);
}  // namespace hogel::optics
