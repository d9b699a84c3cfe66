// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hogel/patterns/pattern_parts.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {
namespace {

using Complex = std::complex<float>;

// Share of a field's energy that its aperture passes, and limits of the aperture's radius, cycles per sample. A phase
// pattern has half as many numbers as a field, so it can reproduce at most half of its frequencies.
constexpr double passed_share = 0.999, max_radius = 0.4, min_radius = 0.01;
// Radius of the band over that of the aperture: a real aperture is neither that sharp nor positioned exactly.
constexpr double margin = 1.1;
// An aperture away from frequency zero is used only if its radius is below this share of one around zero.
constexpr double max_radius_ratio = 0.8;

// Frequency k of a transform of `length` samples, cycles per sample, −0.5..0.5.
double frequency(std::size_t k, std::size_t length) {
    const double f = static_cast<double>(k) / static_cast<double>(length);
    return f < 0.5 ? f : f - 1;
}

double distance(double x, double y, const Aperture& from) {
    return std::hypot(std::remainder(x - from.x, 1.0), std::remainder(y - from.y, 1.0));
}

// Σ|F|² e^{2πif} by columns and rows; the angles are the mean frequencies.
struct MeanFrequency {
    std::complex<double> x = 0, y = 0;
    void operator+=(const MeanFrequency& other) {
        x += other.x;
        y += other.y;
    }
};

Aperture mean_frequency(View<const Complex, 2> spectrum) {
    const std::size_t rows = spectrum.extent(0), columns = spectrum.extent(1);
    const double two_pi = 2 * std::numbers::pi;
    const MeanFrequency mean = sum_of_lines(rows, [&](std::size_t y) {
        MeanFrequency line;
        const std::complex<double> row_phase = std::polar(1.0, two_pi * frequency(y, rows));
        for (std::size_t x = 0; x < columns; ++x) {
            const double power = std::norm(spectrum(y, x));
            line.x += power * std::polar(1.0, two_pi * frequency(x, columns));
            line.y += power * row_phase;
        }
        return line;
    });
    return {std::arg(mean.x) / two_pi, std::arg(mean.y) / two_pi, 0};
}

// Energy by distance from the middle of an aperture.
struct LightByDistance {
    static constexpr std::size_t steps = 1024;
    static constexpr double width = 0.708 / steps;  // cycles; no frequency is farther than √½
    std::array<double, steps> light{};
    void operator+=(const LightByDistance& other) {
        for (std::size_t i = 0; i < steps; ++i) light[i] += other.light[i];
    }
};

// Radius around the middle of an aperture that contains a share of the energy.
double radius_around(View<const Complex, 2> spectrum, const Aperture& middle, double share) {
    const std::size_t rows = spectrum.extent(0), columns = spectrum.extent(1);
    const LightByDistance all = sum_of_lines(rows, [&](std::size_t y) {
        LightByDistance line;
        for (std::size_t x = 0; x < columns; ++x) {
            const double r = distance(frequency(x, columns), frequency(y, rows), middle);
            line.light[static_cast<std::size_t>(r / LightByDistance::width)] += std::norm(spectrum(y, x));
        }
        return line;
    });
    double sum = 0, within = 0;
    for (const double light : all.light) sum += light;
    std::size_t step = 0;
    while (step < LightByDistance::steps && within < share * sum) within += all.light[step++];
    return static_cast<double>(step) * LightByDistance::width;
}

Aperture aperture_for(View<const Complex, 2> spectrum) {
    Aperture around_zero, around_mean = mean_frequency(spectrum);
    around_zero.radius = radius_around(spectrum, around_zero, passed_share);
    around_mean.radius = radius_around(spectrum, around_mean, passed_share);
    Aperture aperture = around_mean.radius < max_radius_ratio * around_zero.radius ? around_mean : around_zero;
    aperture.radius = std::clamp(aperture.radius, min_radius, max_radius);
    return aperture;
}

}  // namespace

Aperture aperture_around(const CarriedOrder& order, Aperture of_field) {
    of_field.x -= order.frequency;
    of_field.radius = std::min(of_field.radius, order.clearance / margin);
    return of_field;
}

FieldBand::FieldBand(View<const Complex, 2> field)
    : fft_(field.extent(0), field.extent(1)),
      target_(field.shape()),
      active_(field.size()),
      active_columns_(field.extent(1)) {
    std::copy_n(field.data(), field.size(), target_.data());
    fft_.forward(target_);
    aperture_ = aperture_for(target_);
    const double radius = std::min(margin * aperture_.radius, max_radius);
    const std::size_t rows = field.extent(0), columns = field.extent(1);
    energy_ = sum_of_lines(rows, [&](std::size_t y) {
        double all = 0;
        for (std::size_t x = 0; x < columns; ++x) {
            all += std::norm(target_(y, x));
            const bool active = distance(frequency(x, columns), frequency(y, rows), aperture_) <= radius;
            active_[y * columns + x] = active ? 1 : 0;
            if (!active) target_(y, x) = 0;
        }
        return all;
    });
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x) active_columns_[x] |= active_[y * columns + x];
}

FieldBand::Match FieldBand::match(Array<Complex, 2>& pattern) const {
    fft_.forward(pattern);
    return match(sum_of_lines(pattern.extent(0), [&](std::size_t y) {
        Sums row;
        for (std::size_t x = 0; x < pattern.extent(1); ++x) add(y, x, pattern(y, x), row);
        return row;
    }));
}

FieldBand::Match FieldBand::match(const Sums& sums) const {
    Match match;
    if (!(sums.energy > 0 && energy_ > 0)) return match;
    match.error = std::max(0.0, 1 - std::norm(sums.product) / (sums.energy * energy_));
    match.scale = std::conj(sums.product) / sums.energy;
    match.slope = Complex(2.0 * std::conj(match.scale) / energy_);
    return match;
}

}  // namespace hogel::patterns
