// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/windows/brightness.h"

#include <complex>
#include <numbers>

namespace hogel::hologram::windows {
namespace {

using Complex = std::complex<float>;

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

// The windows of one point: that of frequency j begins at sample starts[i] of the sum and has the values from i · side.
struct PointWindows {
    std::vector<std::ptrdiff_t> frequencies, starts;
    std::vector<Complex> values;
    std::size_t length = 0;  // of their sum
};

PointWindows windows_of_point(const Line& line, const Fan& fan, double depth) {
    const std::size_t side = line.window.size();
    const double step = line.wavelength / (static_cast<double>(side) * line.pitch);
    const double hop = static_cast<double>(line.hop) * line.pitch;
    const auto reach = static_cast<std::ptrdiff_t>((side - 1) / 2);
    PointWindows point;
    for (std::ptrdiff_t j = -reach; j <= reach; ++j) {
        const double sine = step * static_cast<double>(j);
        if (std::abs(sine) >= 1) continue;
        const double U = -sine * fan.slant / std::sqrt(1 - sine * sine);
        if (std::abs(U - fan.center) > fan.half) continue;
        const double hops = std::round(-U * depth / hop), path = std::hypot(depth * fan.slant, hops * hop) - depth;
        point.frequencies.push_back(j);
        point.starts.push_back(static_cast<std::ptrdiff_t>(hops) * static_cast<std::ptrdiff_t>(line.hop));
        const double a_sample = static_cast<double>(j) / static_cast<double>(side);
        const double first = path / line.wavelength - 0.5 * static_cast<double>(side - 1) * a_sample;
        auto wave = std::polar(1.0, 2 * std::numbers::pi * (first - std::round(first)));
        const auto turn = std::polar(1.0, 2 * std::numbers::pi * a_sample);
        for (const float weight : line.window) {
            point.values.push_back(static_cast<Complex>(wave) * weight);
            wave *= turn;
        }
    }
    if (point.starts.empty()) return point;
    const auto [low, high] = std::ranges::minmax(point.starts);
    for (std::ptrdiff_t& start : point.starts) start -= low;
    point.length = static_cast<std::size_t>(high - low) + side;
    return point;
}

// The factor of a window that interferes with no other: as one window begins at every hop, it must have the energy of
// `hop` samples of modulus one.
float factor_alone(const Line& line) {
    float energy = 0;
    for (const float weight : line.window) energy += weight * weight;
    return std::sqrt(static_cast<float>(line.hop) / energy);
}

// The factors b_j of a point's windows.
std::vector<float> factors_of(const PointWindows& point, const Line& line) {
    const std::size_t side = line.window.size();
    const float alone = factor_alone(line), wanted = static_cast<float>(line.hop);
    std::vector<float> factors(point.starts.size(), alone);
    std::vector<Complex> sum(point.length);
    constexpr int rounds = 5;
    for (int round = 0; round < rounds; ++round) {
        std::ranges::fill(sum, Complex(0));
        for (std::size_t i = 0; i < factors.size(); ++i)
            for (std::size_t p = 0; p < side; ++p)
                sum[static_cast<std::size_t>(point.starts[i]) + p] += factors[i] * point.values[i * side + p];
        for (std::size_t i = 0; i < factors.size(); ++i) {
            float share = 0;
            for (std::size_t p = 0; p < side; ++p) {
                const Complex a = point.values[i * side + p], b = sum[static_cast<std::size_t>(point.starts[i]) + p];
                share += a.real() * b.real() + a.imag() * b.imag();
            }
            // A window that others nearly cancel would need an amplitude without bound.
            factors[i] *= std::sqrt(wanted / std::max(factors[i] * share, 0.25f * wanted));
            factors[i] = std::clamp(factors[i], 0.05f * alone, 2 * alone);
        }
    }
    return factors;
}

std::vector<float> factors_along(const Line& line, const Fan& fan, double depth_step, std::size_t steps) {
    const std::size_t reach = (line.window.size() - 1) / 2;
    std::vector<float> table((2 * reach + 1) * steps, factor_alone(line));
    // The last step stands for all larger depths, whose windows lie apart.
    for (std::size_t step = 0; step + 1 < steps; ++step) {
        const PointWindows point = windows_of_point(line, fan, depth_step * (static_cast<double>(step) + 0.5));
        const std::vector<float> factors = factors_of(point, line);
        for (std::size_t i = 0; i < factors.size(); ++i)
            table[static_cast<std::size_t>(point.frequencies[i] + static_cast<std::ptrdiff_t>(reach)) * steps + step] =
                factors[i];
    }
    return table;
}

}  // namespace

WindowBrightness::WindowBrightness(const LightFieldGrid& rays, const FieldGrid& grid, std::size_t hop,
                                   std::span<const float> window)
    : reach_(static_cast<std::ptrdiff_t>((window.size() - 1) / 2)) {
    const double pitch = grid.plane.pitch_x, extent = static_cast<double>(window.size()) * pitch;
    const double depth_step = 1.25 * extent * extent / grid.wavelength / static_cast<double>(steps - 1);
    steps_a_metre_ = static_cast<float>(1 / depth_step);
    const Line line{window, hop, pitch, grid.wavelength};
    own_share_ = 1 / (factor_alone(line) * factor_alone(line));
    const auto slant = [](double other) { return std::sqrt(1 + other * other); };
    const Fan across{rays.center_u(), rays.half_u(), slant(rays.center_v())},
        down{rays.center_v(), rays.half_v(), slant(rays.center_u())};
    across_ = factors_along(line, across, depth_step, steps);
    down_ = down == across ? across_ : factors_along(line, down, depth_step, steps);
}

}  // namespace hogel::hologram::windows
