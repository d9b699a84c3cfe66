// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/plane_wave_sum.h"

#include <cmath>
#include <numbers>

namespace hogel::stereogram {
namespace {

constexpr double shape = 2.3 * 6;            // parameter of the Kaiser–Bessel kernel, for a grid twice as fine
constexpr std::size_t steps_per_unit = 512;  // of the kernel's table, with linear interpolation

}  // namespace

PlaneWaveSum::PlaneWaveSum(std::size_t samples)
    : samples_(samples), size_(std::max<std::size_t>(2 * samples, width)), fft_(size_, size_) {
    constexpr double half = 0.5 * width;
    kernel_.resize(width / 2 * steps_per_unit + 2, 0.0f);
    for (std::size_t i = 0; i <= width / 2 * steps_per_unit; ++i) {
        const double x = static_cast<double>(i) / steps_per_unit / half;
        kernel_[i] = static_cast<float>(std::cyl_bessel_i(0.0, shape * std::sqrt(std::max(0.0, 1 - x * x))) /
                                        std::cyl_bessel_i(0.0, shape));
    }
    for (std::size_t i = 0; i < samples; ++i) {
        const double position =
            (static_cast<double>(i) - std::floor(0.5 * static_cast<double>(samples))) / static_cast<double>(size_);
        const double root = std::sqrt(shape * shape - std::pow(std::numbers::pi * width * position, 2));
        correction_.push_back(static_cast<float>(std::cyl_bessel_i(0.0, shape) * root / (width * std::sinh(root))));
    }
}

Array<std::complex<float>, 2> PlaneWaveSum::make_spectrum() const {
    return Array<std::complex<float>, 2>({size_, size_});
}

PlaneWaveSum::Spread PlaneWaveSum::spread(double frequency) const {
    const double center = frequency * static_cast<double>(size_);
    const double first = std::ceil(center - 0.5 * width);
    Spread result;
    const auto size = static_cast<std::ptrdiff_t>(size_);
    result.first = static_cast<std::size_t>(((static_cast<std::ptrdiff_t>(first) % size) + size) % size);
    for (std::size_t i = 0; i < width; ++i) {
        const double position = std::abs(first + static_cast<double>(i) - center) * steps_per_unit;
        const auto step = static_cast<std::size_t>(position);
        const auto fraction = static_cast<float>(position - static_cast<double>(step));
        result.weights[i] =
            step + 1 < kernel_.size() ? (1 - fraction) * kernel_[step] + fraction * kernel_[step + 1] : 0;
    }
    return result;
}

void PlaneWaveSum::add(std::complex<float> amplitude, double column_frequency, double row_frequency,
                       View<std::complex<float>, 2> spectrum) const {
    // For even n the middle of the square lies half a sample before the origin of the transform.
    const double offset = samples_ % 2 == 0 ? 0.5 : 0.0;
    const double cycles = offset * (column_frequency + row_frequency);
    amplitude *= std::complex<float>(std::polar(1.0, 2 * std::numbers::pi * cycles));
    const Spread columns = spread(column_frequency), rows = spread(row_frequency);
    for (std::size_t j = 0; j < width; ++j) {
        const std::complex<float> line = amplitude * rows.weights[j];
        std::complex<float>* row = &spectrum((rows.first + j) % size_, 0);
        for (std::size_t i = 0; i < width; ++i) row[(columns.first + i) % size_] += line * columns.weights[i];
    }
}

void PlaneWaveSum::transform(View<std::complex<float>, 2> spectrum, View<std::complex<float>, 2> samples) const {
    fft_.backward(spectrum);
    const std::size_t first = size_ - samples_ / 2;
    for (std::size_t q = 0; q < samples_; ++q)
        for (std::size_t p = 0; p < samples_; ++p)
            samples(q, p) = spectrum((q + first) % size_, (p + first) % size_) * (correction_[q] * correction_[p]);
}

}  // namespace hogel::stereogram
