// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/focus/plane_waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogel::optics {
namespace {

using Complex = std::complex<float>;

// Averages 2 × 2 samples.
void halve(std::vector<double>& light, std::size_t& height, std::size_t& width) {
    const std::size_t down = height / 2, across = width / 2;
    std::vector<double> means(down * across);
    for (std::size_t y = 0; y < down; ++y)
        for (std::size_t x = 0; x < across; ++x) {
            const double* corner = &light[2 * y * width + 2 * x];
            means[y * across + x] = (corner[0] + corner[1] + corner[width] + corner[width + 1]) / 4;
        }
    light = std::move(means);
    height = down;
    width = across;
}

// Returns half the width between the 5 % and 95 % points of a circular distribution that begins at its minimum, in
// cycles per sample.
double half_width(const std::vector<double>& amplitudes) {
    const std::size_t n = amplitudes.size(),
                      from = static_cast<std::size_t>(std::ranges::min_element(amplitudes) - amplitudes.begin());
    double sum = 0;
    for (const double amplitude : amplitudes) sum += amplitude;
    std::size_t first = 0, last = 0;
    double below = 0;
    for (std::size_t i = 0; i < n; ++i) {
        below += amplitudes[(from + i) % n];
        if (below < 0.05 * sum) first = i + 1;
        if (below < 0.95 * sum) last = i + 1;
    }
    return static_cast<double>(last + 1 - first) / static_cast<double>(2 * n);
}

}  // namespace

void LightSums::add(const LightSums& other) {
    for (std::size_t s = 0; s < count.size(); ++s) {
        count[s] += other.count[s];
        light[s] += other.light[s];
        squares[s] += other.squares[s];
    }
}

FocusSearch::Contrasts LightSums::contrasts() const {
    FocusSearch::Contrasts contrasts{};
    for (std::size_t s = 0; s < contrasts.size(); ++s)
        if (light[s] > 0) contrasts[s] = std::max(0.0, squares[s] * count[s] / (light[s] * light[s]) - 1);
    return contrasts;
}

PlaneWaves::PlaneWaves(const FieldSource& field, const Region& region)
    : grid_(field.grid()),
      width_(region.width),
      height_(region.height),
      fft_(height_, width_),
      spectrum_({height_, width_}) {
    field.read(region, 0, spectrum_);
    fft_.forward(spectrum_);
    // Normalises forward and backward transform to the identity, which makes parts of different sizes comparable.
    for (Complex& wave : spectrum_.elements()) wave /= static_cast<float>(width_ * height_);
}

LightSums PlaneWaves::at(double depth) const {
    Array<Complex, 2> wave(spectrum_.shape());
    const double inverse = 1 / grid_.wavelength;
    // The four frequencies ±f_x, ±f_y have the same phase factor.
    for (std::size_t y = 0; y <= height_ / 2; ++y) {
        const double fy = static_cast<double>(y) / static_cast<double>(height_) / grid_.plane.pitch_y;
        const std::size_t mirrored_y = (height_ - y) % height_;
        for (std::size_t x = 0; x <= width_ / 2; ++x) {
            const double fx = static_cast<double>(x) / static_cast<double>(width_) / grid_.plane.pitch_x;
            const double square = fx * fx + fy * fy;
            if (square >= inverse * inverse) continue;
            // √(1/λ² − f²) − 1/λ without cancellation
            const double along = -square / (std::sqrt(inverse * inverse - square) + inverse);
            const Complex phase_factor(std::polar(1.0, -2 * std::numbers::pi * std::remainder(along * depth, 1.0)));
            const std::size_t mirrored_x = (width_ - x) % width_;
            wave(y, x) = spectrum_(y, x) * phase_factor;
            wave(y, mirrored_x) = spectrum_(y, mirrored_x) * phase_factor;
            wave(mirrored_y, x) = spectrum_(mirrored_y, x) * phase_factor;
            wave(mirrored_y, mirrored_x) = spectrum_(mirrored_y, mirrored_x) * phase_factor;
        }
    }
    fft_.backward(wave);
    return sums_of(wave);
}

double PlaneWaves::band() const {
    std::vector<double> across(width_), down(height_);
    for (std::size_t y = 0; y < height_; ++y)
        for (std::size_t x = 0; x < width_; ++x) {
            const auto amplitude = static_cast<double>(std::abs(spectrum_(y, x)));
            across[x] += amplitude;
            down[y] += amplitude;
        }
    return (half_width(across) / grid_.plane.pitch_x + half_width(down) / grid_.plane.pitch_y) / 2;
}

LightSums PlaneWaves::sums_of(const Array<Complex, 2>& wave) const {
    LightSums sums;
    std::size_t height = height_, width = width_;
    std::vector<double> light(height * width);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = std::norm(wave.data()[i]);
    for (std::size_t s = 0; s < FocusSearch::cells.size(); ++s) {
        if (s > 0) halve(light, height, width);
        for (const double value : light) sums.light[s] += value, sums.squares[s] += value * value;
        sums.count[s] = static_cast<double>(light.size());
    }
    // Squared differences of adjacent samples, without wrapping around at the borders of the part.
    constexpr std::size_t edges = FocusSearch::edges;
    for (std::size_t y = 0; y + 1 < height_; ++y)
        for (std::size_t x = 0; x + 1 < width_; ++x) {
            const double value{std::norm(wave(y, x + 1) - wave(y, x)) + std::norm(wave(y + 1, x) - wave(y, x))};
            sums.light[edges] += value;
            sums.squares[edges] += value * value;
        }
    sums.count[edges] = static_cast<double>((height_ - 1) * (width_ - 1));
    return sums;
}

}  // namespace hogel::optics
