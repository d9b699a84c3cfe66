// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/propagation/line_transform.h"

#include <algorithm>
#include <cmath>

#include "hogel/optics/phase_walk.h"

namespace hogel::optics::propagation {
namespace {

using Complex = std::complex<float>;

double square(std::size_t i) { return static_cast<double>(i) * static_cast<double>(i); }

}  // namespace

std::size_t LineTransform::convolution(std::size_t inputs, std::size_t outputs) {
    return math::good_fft_size(inputs + outputs - 1);
}

double LineTransform::operations(std::size_t inputs, std::size_t outputs, std::size_t transform) {
    const auto n = static_cast<double>(transform > 0 ? transform : convolution(inputs, outputs));
    return (transform > 0 ? 1 : 2) * 5 * n * std::log2(n) + 6 * static_cast<double>(inputs + outputs);
}

LineTransform::LineTransform(const Steps& from, const Steps& to, int sign, double scale, std::size_t transform)
    : fft_(transform > 0 ? transform : convolution(from.count, to.count)),
      forward_(sign < 0),
      convolves_(transform == 0),
      input_factors_(from.count),
      output_factors_(to.count) {
    // a_i b_j = a_i b_0 + a_0 (b_j − b_0) + ij ν.
    const double nu = from.step * to.step;
    const auto half_square = [&](std::size_t i) { return convolves_ ? std::fmod(0.5 * nu * square(i), 1.0) : 0.0; };
    for (std::size_t i = 0; i < from.count; ++i) {
        const double a = from.first + static_cast<double>(i) * from.step;
        input_factors_[i] = Complex(scale * unit_phasor(sign * (a * to.first + half_square(i))));
    }
    for (std::size_t j = 0; j < to.count; ++j)
        output_factors_[j] =
            Complex(unit_phasor(sign * (from.first * static_cast<double>(j) * to.step + half_square(j))));
    if (!convolves_) return;
    const std::size_t n = fft_.size();
    chirp_.assign(n, Complex(0));
    const double mean = 1 / static_cast<double>(n);
    for (std::size_t k = 0; k < to.count; ++k) chirp_[k] = Complex(mean * unit_phasor(-sign * half_square(k)));
    for (std::size_t k = 1; k < from.count; ++k) chirp_[n - k] = Complex(mean * unit_phasor(-sign * half_square(k)));
    fft_.forward(chirp_.data());
}

std::size_t LineTransform::buffer() const { return std::max({fft_.size(), inputs(), outputs()}); }

void LineTransform::operator()(std::span<Complex> line) const {
    for (std::size_t i = 0; i < inputs(); ++i) line[i] = times(line[i], input_factors_[i]);
    if (convolves_)
        by_convolution(line);
    else
        by_transform(line);
    for (std::size_t j = 0; j < outputs(); ++j) line[j] = times(line[j], output_factors_[j]);
}

// Inputs or outputs may outnumber the transform by a few; the excess wraps around by one period.
void LineTransform::by_transform(std::span<Complex> line) const {
    const std::size_t n = fft_.size();
    for (std::size_t i = n; i < inputs(); ++i) line[i % n] += line[i];
    if (inputs() < n) std::ranges::fill(line.subspan(inputs(), n - inputs()), Complex(0));
    forward_ ? fft_.forward(line.data()) : fft_.backward(line.data());
    for (std::size_t j = n; j < outputs(); ++j) line[j] = line[j % n];
}

void LineTransform::by_convolution(std::span<Complex> line) const {
    const std::size_t n = fft_.size();
    std::ranges::fill(line.subspan(inputs(), n - inputs()), Complex(0));
    fft_.forward(line.data());
    for (std::size_t i = 0; i < n; ++i) line[i] = times(line[i], chirp_[i]);
    fft_.backward(line.data());
}

}  // namespace hogel::optics::propagation
