// SPDX-License-Identifier: Apache-2.0
// The vector twins of kernels.cpp, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/optics/narrow_band/kernels_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

#include "hogel/optics/narrow_band/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::optics::narrow_band {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// A vector of one lane cannot hold a complex number.
void WeightedRows(const std::complex<float>* rows, std::size_t stride, std::span<const std::complex<float>> weights,
                  std::span<std::complex<float>> out) {
    weighted_rows_plain(rows, stride, weights, out);
}

void DecimatedLine(const std::complex<float>* line, std::size_t step, std::span<const float> taps,
                   std::span<std::complex<float>> out) {
    decimated_line_plain(line, step, taps, out);
}

void Multiply(const std::complex<float>* a, const std::complex<float>* b, std::span<std::complex<float>> out) {
    multiply_plain(a, b, out);
}
#else
// Complex numbers are pairs of lanes. The sum of complex weights w times complex vectors z is accumulated as two real
// sums, a = Σ re(w)·z and b = Σ im(w)·z; swapping b's lanes and negating one of them is done once, at the end.
template <class D, class V>
HWY_INLINE V join(D d, V a, V b) {
    const V sign = hn::OddEven(hn::Set(d, 1.0f), hn::Set(d, -1.0f));
    return hn::MulAdd(sign, hn::Shuffle2301(b), a);
}

template <std::size_t vectors>
HWY_INLINE void rows_block(const float* rows, std::size_t stride, std::span<const std::complex<float>> weights,
                           float* out) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    using V = hn::Vec<decltype(d)>;
    V a[vectors], b[vectors];
    for (std::size_t i = 0; i < vectors; ++i) a[i] = b[i] = hn::Zero(d);
    for (std::size_t r = 0; r < weights.size(); ++r) {
        const V re = hn::Set(d, weights[r].real()), im = hn::Set(d, weights[r].imag());
        for (std::size_t i = 0; i < vectors; ++i) {
            const V z = hn::LoadU(d, rows + r * stride + i * lanes);
            a[i] = hn::MulAdd(re, z, a[i]);
            b[i] = hn::MulAdd(im, z, b[i]);
        }
    }
    for (std::size_t i = 0; i < vectors; ++i) hn::StoreU(join(d, a[i], b[i]), d, out + i * lanes);
}

void WeightedRows(const std::complex<float>* rows, std::size_t stride, std::span<const std::complex<float>> weights,
                  std::span<std::complex<float>> out) {
    const std::size_t lanes = hn::Lanes(hn::ScalableTag<float>());
    const auto* in = reinterpret_cast<const float*>(rows);
    auto* to = reinterpret_cast<float*>(out.data());
    const std::size_t floats = 2 * out.size();
    std::size_t x = 0;
    for (; x + 4 * lanes <= floats; x += 4 * lanes) rows_block<4>(in + x, 2 * stride, weights, to + x);
    for (; x + lanes <= floats; x += lanes) rows_block<1>(in + x, 2 * stride, weights, to + x);
    if (x < floats) weighted_rows_plain(rows + x / 2, stride, weights, out.subspan(x / 2));
}

void DecimatedLine(const std::complex<float>* line, std::size_t step, std::span<const float> taps,
                   std::span<std::complex<float>> out) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    const std::size_t whole = taps.size() / lanes * lanes;
    for (std::size_t n = 0; n < out.size(); ++n) {
        const auto* z = reinterpret_cast<const float*>(line + n * step);
        auto sum = hn::Zero(d);
        for (std::size_t k = 0; k < whole; k += lanes)
            sum = hn::MulAdd(hn::LoadU(d, &taps[k]), hn::LoadU(d, z + k), sum);
        float lane[HWY_MAX_BYTES / sizeof(float)];
        hn::StoreU(sum, d, lane);
        float re = 0, im = 0;
        for (std::size_t i = 0; i < lanes; i += 2) {
            re += lane[i];
            im += lane[i + 1];
        }
        for (std::size_t k = whole; k < taps.size(); k += 2) {
            re += taps[k] * z[k];
            im += taps[k] * z[k + 1];
        }
        out[n] = {re, im};
    }
}

void Multiply(const std::complex<float>* a, const std::complex<float>* b, std::span<std::complex<float>> out) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d), floats = 2 * out.size();
    const auto *p = reinterpret_cast<const float*>(a), *q = reinterpret_cast<const float*>(b);
    auto* to = reinterpret_cast<float*>(out.data());
    std::size_t x = 0;
    for (; x + lanes <= floats; x += lanes) {
        const auto u = hn::LoadU(d, p + x), v = hn::LoadU(d, q + x);
        hn::StoreU(join(d, hn::Mul(u, hn::DupEven(v)), hn::Mul(u, hn::DupOdd(v))), d, to + x);
    }
    if (x < floats) multiply_plain(a + x / 2, b + x / 2, out.subspan(x / 2));
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::optics::narrow_band
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::optics::narrow_band {

HWY_EXPORT(WeightedRows);
HWY_EXPORT(DecimatedLine);
HWY_EXPORT(Multiply);

void weighted_rows(const std::complex<float>* rows, std::size_t stride, std::span<const std::complex<float>> weights,
                   std::span<std::complex<float>> out) {
    HWY_DYNAMIC_DISPATCH(WeightedRows)(rows, stride, weights, out);
}

void decimated_line(const std::complex<float>* line, std::size_t step, std::span<const float> taps,
                    std::span<std::complex<float>> out) {
    HWY_DYNAMIC_DISPATCH(DecimatedLine)(line, step, taps, out);
}

void multiply(const std::complex<float>* a, const std::complex<float>* b, std::span<std::complex<float>> out) {
    HWY_DYNAMIC_DISPATCH(Multiply)(a, b, out);
}

}  // namespace hogel::optics::narrow_band
#endif
