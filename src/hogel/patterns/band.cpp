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

// The share of a field's light that its aperture lets through, where it is no wider than a phase pattern allows: a
// pattern has half as many numbers as a field, so it can show at most half of its frequencies.
constexpr double passed_share = 0.999, max_radius = 0.4, min_radius = 0.01;
// How much farther than the aperture the band reaches, because an aperture is not that sharp, nor set that exactly.
constexpr double margin = 1.1;
// An aperture beside frequency zero must be this much smaller than one around it.
constexpr double worth_moving = 0.8;

// Frequency k of a line of `length`, cycles per sample, -0.5..0.5.
double frequency(std::size_t k, std::size_t length) {
    const double f = static_cast<double>(k) / static_cast<double>(length);
    return f < 0.5 ? f : f - 1;
}

double distance(double x, double y, const Aperture& from) {
    return std::hypot(std::remainder(x - from.x, 1.0), std::remainder(y - from.y, 1.0));
}

// Σ|F|² e^{2πif} by columns and rows, whose angles are the mean frequencies.
struct MeanFrequency {
    std::complex<double> x = 0, y = 0;
    void operator+=(const MeanFrequency& other) {
        x += other.x;
        y += other.y;
    }
};

Aperture mean_frequency(View<const Complex, 2> spectrum) {
    const std::size_t rows = spectrum.extent(0), columns = spectrum.extent(1);
    const double turn = 2 * std::numbers::pi;
    const MeanFrequency mean = sum_of_lines(rows, [&](std::size_t y) {
        MeanFrequency line;
        const std::complex<double> down = std::polar(1.0, turn * frequency(y, rows));
        for (std::size_t x = 0; x < columns; ++x) {
            const double power = std::norm(spectrum(y, x));
            line.x += power * std::polar(1.0, turn * frequency(x, columns));
            line.y += power * down;
        }
        return line;
    });
    return {std::arg(mean.x) / turn, std::arg(mean.y) / turn, 0};
}

// The light by its distance from the middle of an aperture.
struct LightByDistance {
    static constexpr std::size_t steps = 1024;
    static constexpr double width = 0.708 / steps;  // cycles; no frequency is farther than √½
    std::array<double, steps> light{};
    void operator+=(const LightByDistance& other) {
        for (std::size_t i = 0; i < steps; ++i) light[i] += other.light[i];
    }
};

// The radius around the middle of an aperture within which a share of the light lies.
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
    Aperture around_zero, beside = mean_frequency(spectrum);
    around_zero.radius = radius_around(spectrum, around_zero, passed_share);
    beside.radius = radius_around(spectrum, beside, passed_share);
    Aperture aperture = beside.radius < worth_moving * around_zero.radius ? beside : around_zero;
    aperture.radius = std::clamp(aperture.radius, min_radius, max_radius);
    return aperture;
}

}  // namespace

Aperture aperture_around(const CarriedOrder& order, Aperture of_field) {
    of_field.x -= order.frequency;
    of_field.radius = std::min(of_field.radius, order.room / margin);
    return of_field;
}

FieldBand::FieldBand(View<const Complex, 2> field)
    : fft_(field.extent(0), field.extent(1)), wanted_(field.shape()), active_(field.size()) {
    std::copy_n(field.data(), field.size(), wanted_.data());
    fft_.forward(wanted_);
    aperture_ = aperture_for(wanted_);
    const double radius = std::min(margin * aperture_.radius, max_radius);
    const std::size_t rows = field.extent(0), columns = field.extent(1);
    energy_ = sum_of_lines(rows, [&](std::size_t y) {
        double all = 0;
        for (std::size_t x = 0; x < columns; ++x) {
            all += std::norm(wanted_(y, x));
            const bool active = distance(frequency(x, columns), frequency(y, rows), aperture_) <= radius;
            active_[y * columns + x] = active ? 1 : 0;
            if (!active) wanted_(y, x) = 0;
        }
        return all;
    });
}

FieldBand::Match FieldBand::match(Array<Complex, 2>& shown) const {
    fft_.forward(shown);
    return match(sum_of_lines(shown.extent(0), [&](std::size_t y) {
        Sums row;
        for (std::size_t x = 0; x < shown.extent(1); ++x) add(y, x, shown(y, x), row);
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
