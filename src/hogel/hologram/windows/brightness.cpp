// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "hogel/hologram/windows/brightness.h"
#include "hogel/math/fft.h"

namespace hogel::hologram::windows {
namespace {

constexpr std::size_t steps = 256;

// The directions along one axis: the middle and half the width of their range of U or V, and the factor by which the
// path to the surface is longer because the fan is oblique along the other axis.
struct Fan {
    double center, half, slant;
    friend bool operator==(const Fan&, const Fan&) = default;
};

// Windows along one axis.
struct Line {
    std::span<const float> window;
    std::size_t hop;
    double pitch, wavelength;
};

double one_dimension(const Line& line, double depth, const Fan& fan, const math::Fft2& fft) {
    const std::size_t side = line.window.size();
    const double step = line.wavelength / (static_cast<double>(side) * line.pitch);
    const double hop = static_cast<double>(line.hop) * line.pitch;
    Array<std::complex<float>, 2> sum({1, fft.width()});
    const auto length = static_cast<std::ptrdiff_t>(fft.width());
    const auto reach = static_cast<std::ptrdiff_t>((side - 1) / 2);
    // Positions are relative to the fan's middle, so that an oblique fan needs no more windows than one straight ahead.
    const double middle_hops = std::round(-fan.center * depth / hop);
    double lit = 0, middle = 0;
    for (std::ptrdiff_t j = -reach; j <= reach; ++j) {
        const double sine = step * static_cast<double>(j);
        if (std::abs(sine) >= 1) continue;
        const double U = -sine * fan.slant / std::sqrt(1 - sine * sine);
        if (std::abs(U - fan.center) > fan.half) continue;
        lit += 1;
        middle += static_cast<double>(j);
        const double hops = std::round(-U * depth / hop), path = std::hypot(depth * fan.slant, hops * hop) - depth;
        const auto first =
            static_cast<std::ptrdiff_t>(hops - middle_hops) * static_cast<std::ptrdiff_t>(line.hop) + length;
        for (std::size_t p = 0; p < side; ++p) {
            const double x = static_cast<double>(p) - 0.5 * static_cast<double>(side - 1);
            const double cycles = static_cast<double>(j) * x / static_cast<double>(side) + path / line.wavelength;
            sum.data()[(first + static_cast<std::ptrdiff_t>(p)) % length] +=
                std::complex<float>(std::polar<double>(line.window[p], 2 * std::numbers::pi * cycles));
        }
    }
    fft.forward(sum);
    if (lit == 0) return 0;
    // The fan covers up to lit/2 of the window's frequencies on either side of its middle, where the weight is largest.
    middle *= static_cast<double>(length) / (lit * static_cast<double>(side));
    const double half = 0.5 * lit * static_cast<double>(length) / static_cast<double>(side);
    double energy = 0, expected = 0;
    for (std::ptrdiff_t f = -length / 2; f < length / 2; ++f) {
        const double away = static_cast<double>(f) - middle;
        if (std::abs(away) >= half) continue;
        const double weight = std::pow(std::cos(0.5 * std::numbers::pi * away / half), 2);
        energy += weight * std::norm(sum.data()[(f + length) % length]) / static_cast<double>(length);
        expected += weight * static_cast<double>(line.hop * side) / static_cast<double>(length);
    }
    return energy > 0 ? std::sqrt(expected / energy) : 0;
}

}  // namespace

WindowBrightness::WindowBrightness(const LightFieldGrid& rays, const FieldGrid& grid, std::size_t hop,
                                   std::span<const float> window) {
    const double pitch = grid.plane.pitch_x, extent = static_cast<double>(window.size()) * pitch;
    const double depth_step = 1.25 * extent * extent / grid.wavelength / (steps - 1);
    steps_a_metre_ = 1 / depth_step;
    const double widest = std::max(rays.half_u(), rays.half_v());
    const double max_shift = widest * depth_step * (steps - 1) / pitch;
    const math::Fft2 spectrum(1, math::good_fft_size(4 * window.size() + 4 * static_cast<std::size_t>(max_shift)));
    const Line line{window, hop, pitch, grid.wavelength};
    const auto slant = [](double other) { return std::sqrt(1 + other * other); };
    const Fan across{rays.center_u(), rays.half_u(), slant(rays.center_v())},
        down{rays.center_v(), rays.half_v(), slant(rays.center_u())};
    for (std::size_t i = 0; i < steps; ++i) {
        const double depth = depth_step * static_cast<double>(i);
        const double u = one_dimension(line, depth, across, spectrum);
        const double v = down == across ? u : one_dimension(line, depth, down, spectrum);
        values_.push_back(static_cast<float>(u * v));
    }
}

float WindowBrightness::operator()(double depth) const {
    const double at = std::min(std::abs(depth) * steps_a_metre_, static_cast<double>(steps - 1));
    const auto below = std::min(static_cast<std::size_t>(at), steps - 2);
    const auto rest = static_cast<float>(at - static_cast<double>(below));
    return (1 - rest) * values_[below] + rest * values_[below + 1];
}

}  // namespace hogel::hologram::windows
