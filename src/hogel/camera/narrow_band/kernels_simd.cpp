// SPDX-License-Identifier: Apache-2.0
// Vector twins of kernels.cpp, compiled for every SIMD target and chosen when first called.
#include <algorithm>
#include <vector>

#include "hogel/camera/narrow_band/kernels.h"
#include "hogel/core/simd_targets-inl.h"

// After simd_targets-inl.h:
#include "hogel/camera/unit_phasors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::narrow_band::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// A vector of one lane cannot hold a complex number.
void DecimatedColumns(const std::complex<float>* rows, const ColumnDecimation& decimation, std::complex<float>* out,
                      std::size_t out_stride, std::size_t count) {
    decimated_columns_plain(rows, decimation, out, out_stride, count);
}

void MakePathPhases(const PathPhases& paths, std::span<std::complex<float>> out) { path_phases_plain(paths, out); }

void DecimatedLine(const std::complex<float>* line, std::size_t step, std::span<const float> taps,
                   std::span<std::complex<float>> out) {
    decimated_line_plain(line, step, taps, out);
}

#else
// Complex numbers are pairs of lanes. The sum of complex weights w times complex vectors z accumulates as two real
// sums, a = Σ re(w)·z and b = Σ im(w)·z. Swapping b's lanes and negating one of them follows once, at the end.
template <class D, class V>
HWY_INLINE V join(D d, V a, V b) {
    const V sign = hn::OddEven(hn::Set(d, 1.0f), hn::Set(d, -1.0f));
    return hn::MulAdd(sign, hn::Shuffle2301(b), a);
}

// Maximum number of outputs to which one row contributes: the width of LowPass.
constexpr std::size_t max_outputs = 9;

// Decimates `vectors` vectors of columns. Each row in turn is multiplied by its phase and added to its outputs, which
// stay in registers. After `step` rows the first output is complete.
template <std::size_t vectors>
HWY_INLINE void columns_block(const float* rows, const ColumnDecimation& decimation, const float* by_row, float* out,
                              std::size_t out_stride, std::size_t count) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    using V = hn::Vec<decltype(d)>;
    V sums[max_outputs][vectors];
    for (auto& sum : sums)
        for (V& part : sum) part = hn::Zero(d);
    const auto height = static_cast<std::ptrdiff_t>(decimation.phases.size());
    const auto step = static_cast<std::ptrdiff_t>(decimation.step);
    // Rows that contribute only to outputs before the first are skipped with it.
    const std::ptrdiff_t groups = static_cast<std::ptrdiff_t>(count + max_outputs) - 1;
    for (std::ptrdiff_t g = 0; g < groups; ++g) {
        const std::ptrdiff_t from = decimation.first + g * step;
        for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(from, 0); r < std::min(from + step, height); ++r) {
            const float* taps = by_row + static_cast<std::size_t>(r - from) * max_outputs;
            const std::complex<float> phase = decimation.phases[static_cast<std::size_t>(r)];
            const V re = hn::Set(d, phase.real()), im = hn::Set(d, phase.imag());
            const float* row = rows + 2 * static_cast<std::size_t>(r) * decimation.stride;
            V z[vectors];
            for (std::size_t i = 0; i < vectors; ++i) {
                const V value = hn::LoadU(d, row + i * lanes);
                z[i] = join(d, hn::Mul(re, value), hn::Mul(im, value));
            }
            for (std::size_t t = 0; t < max_outputs; ++t) {
                const V tap = hn::Set(d, taps[t]);
                for (std::size_t i = 0; i < vectors; ++i) sums[t][i] = hn::MulAdd(tap, z[i], sums[t][i]);
            }
        }
        const std::ptrdiff_t done = g - static_cast<std::ptrdiff_t>(max_outputs) + 1;
        if (done >= 0)
            for (std::size_t i = 0; i < vectors; ++i)
                hn::StoreU(sums[0][i], d, out + 2 * static_cast<std::size_t>(done) * out_stride + i * lanes);
        for (std::size_t i = 0; i < vectors; ++i) {
            for (std::size_t t = 0; t + 1 < max_outputs; ++t) sums[t][i] = sums[t + 1][i];
            sums[max_outputs - 1][i] = hn::Zero(d);
        }
    }
}

void DecimatedColumns(const std::complex<float>* rows, const ColumnDecimation& decimation, std::complex<float>* out,
                      std::size_t out_stride, std::size_t count) {
    if (decimation.taps.size() > max_outputs * decimation.step)
        return decimated_columns_plain(rows, decimation, out, out_stride, count);
    // Row j of a group of `step` rows is tap j + (max_outputs − 1 − t)·step of output t, counted from the oldest.
    std::vector<float> by_row(decimation.step * max_outputs);
    for (std::size_t j = 0; j < decimation.step; ++j)
        for (std::size_t t = 0; t < max_outputs; ++t) {
            const std::size_t k = j + (max_outputs - 1 - t) * decimation.step;
            if (k < decimation.taps.size()) by_row[j * max_outputs + t] = decimation.taps[k];
        }
    const std::size_t lanes = hn::Lanes(hn::ScalableTag<float>()), floats = 2 * decimation.width;
    const auto* in = reinterpret_cast<const float*>(rows);
    auto* to = reinterpret_cast<float*>(out);
    std::size_t x = 0;
    // Two vectors where registers suffice.
    if constexpr (HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86)
        for (; x + 2 * lanes <= floats; x += 2 * lanes)
            columns_block<2>(in + x, decimation, by_row.data(), to + x, out_stride, count);
    for (; x + lanes <= floats; x += lanes)
        columns_block<1>(in + x, decimation, by_row.data(), to + x, out_stride, count);
    if (x == floats) return;
    ColumnDecimation remainder = decimation;
    remainder.width = (floats - x) / 2;
    decimated_columns_plain(rows + x / 2, remainder, out + x / 2, out_stride, count);
}

void MakePathPhases(const PathPhases& paths, std::span<std::complex<float>> out) {
    const hn::ScalableTag<double> dd;
    const hn::Rebind<float, decltype(dd)> df;
    const std::size_t lanes = hn::Lanes(dd);
    const auto steps = hn::Iota(dd, 0);
    const auto frequency = hn::Set(dd, 1 / paths.wavelength);
    std::size_t i = 0;
    for (; i + lanes <= out.size(); i += lanes) {
        const auto x = hn::MulAdd(hn::Add(steps, hn::Set(dd, static_cast<double>(i))), hn::Set(dd, paths.pitch),
                                  hn::Set(dd, paths.first));
        const auto cycles =
            hn::MulSub(hn::Sqrt(hn::MulAdd(x, x, hn::Set(dd, paths.square))), frequency, hn::Set(dd, paths.offset));
        hn::Vec<decltype(df)> cosine, sine;
        camera::HWY_NAMESPACE::unit_phasors(dd, cycles, cosine, sine);
        hn::StoreInterleaved2(cosine, sine, df, reinterpret_cast<float*>(&out[i]));
    }
    PathPhases remainder = paths;
    remainder.first += static_cast<double>(i) * paths.pitch;
    path_phases_plain(remainder, out.subspan(i));
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

#endif

}  // namespace hogel::camera::narrow_band::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::narrow_band {
HOGEL_DISPATCH(decimated_columns, DecimatedColumns);
HOGEL_DISPATCH(path_phases, MakePathPhases);
HOGEL_DISPATCH(decimated_line, DecimatedLine);
}  // namespace hogel::camera::narrow_band
