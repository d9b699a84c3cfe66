// SPDX-License-Identifier: Apache-2.0
// Vector twin of demodulation.cpp, compiled for every SIMD target and chosen when first called.
#include <cmath>
#include <numbers>

#include "hogel/camera/hogel_spectra/demodulation.h"
#include "hogel/core/simd_targets-inl.h"

// After simd_targets-inl.h:
#include "hogel/camera/unit_phasors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::hogel_spectra::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void Demodulation(const SampleLine& across, const SampleLine& down, double bend, std::size_t rows, float* phases,
                  std::size_t row_stride) {
    demodulation_plain(across, down, bend, rows, phases, row_stride);
}
#else
// Phases of a line, real and imaginary parts. √(r² + c) − r = c/(√(r² + c) + r) needs no double precision.
void line_phases(const SampleLine& line, float* re, float* im) {
    const hn::CappedTag<float, lanes> d;
    const double square = line.first * line.first + line.square, distance = std::sqrt(square);
    const double total = distance * line.frequency - line.offset;
    const auto set = [&](double value) HWY_ATTR { return hn::Set(d, static_cast<float>(value)); };
    const auto start = set(total - std::round(total)), r = set(distance), r_square = set(square);
    const auto slope = set(2 * line.first * line.step), bend = set(line.step * line.step);
    const auto frequency = set(line.frequency);
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const auto position = hn::Iota(d, static_cast<float>(sample_position(i)));
        const auto change = hn::Mul(hn::MulAdd(bend, position, slope), position);
        const auto longer = hn::Div(change, hn::Add(hn::Sqrt(hn::Add(r_square, change)), r));
        const auto cycles = hn::MulAdd(longer, frequency, start);
        hn::Vec<decltype(d)> cosine, sine;
        camera::HWY_NAMESPACE::unit_phasors_within(hn::Sub(cycles, hn::Round(cycles)), cosine, sine);
        hn::Store(cosine, d, re + i);
        hn::Store(sine, d, im + i);
    }
}

void Demodulation(const SampleLine& across, const SampleLine& down, double bend, std::size_t rows, float* phases,
                  std::size_t row_stride) {
    const hn::CappedTag<float, lanes> d;
    HWY_ALIGN float across_re[lanes], across_im[lanes], down_re[lanes], down_im[lanes];
    line_phases(across, across_re, across_im);
    line_phases(down, down_re, down_im);
    for (std::size_t y = 0; y < rows; ++y) {
        const auto angle = hn::Set(d, static_cast<float>(2 * std::numbers::pi * bend * sample_position(y)));
        const auto c = hn::Set(d, down_re[y]), s = hn::Set(d, down_im[y]);
        for (std::size_t x = 0; x < lanes; x += hn::Lanes(d)) {
            // e^{iθ} for a small θ
            const auto theta = hn::Mul(angle, hn::Iota(d, static_cast<float>(sample_position(x))));
            const auto square = hn::Mul(theta, theta);
            const auto cosine = hn::MulAdd(square, hn::Set(d, -0.5f), hn::Set(d, 1.0f));
            const auto sine = hn::Mul(theta, hn::MulAdd(square, hn::Set(d, -1.0f / 6), hn::Set(d, 1.0f)));
            const auto a = hn::Load(d, across_re + x), b = hn::Load(d, across_im + x);
            const auto e = hn::NegMulAdd(b, s, hn::Mul(a, c)), f = hn::MulAdd(b, c, hn::Mul(a, s));
            hn::Store(hn::NegMulAdd(f, sine, hn::Mul(e, cosine)), d, phases + 2 * y * row_stride + x);
            hn::Store(hn::MulAdd(f, cosine, hn::Mul(e, sine)), d, phases + (2 * y + 1) * row_stride + x);
        }
    }
}
#endif

}  // namespace hogel::camera::hogel_spectra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::hogel_spectra {
HOGEL_DISPATCH(demodulation, Demodulation);
}  // namespace hogel::camera::hogel_spectra
