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
    double point_spacing;  // of the points of a surface, in hogels
    int offsets;           // how many places between hogels the points take, evenly
};

// The windows of one point: that of frequency j begins at sample starts[i] of the sum and has the values from i · side.
struct PointWindows {
    std::vector<std::ptrdiff_t> frequencies, starts;
    std::vector<Complex> values;
    std::size_t length = 0;  // of their sum
};

// @param offset  of the point from a hogel, in hogels
PointWindows windows_of_point(const Line& line, const Fan& fan, double depth, double offset) {
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
        const double met = offset - U * depth / hop, hops = std::round(met);
        if (std::abs(hops - met) > 0.5 * line.point_spacing) continue;  // a ray of no hogel is nearest to this point
        const double path = std::hypot(depth * fan.slant, (hops - offset) * hop) - depth;
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

// The factors b_j by frequency, the same for points of all these offsets: a window has the energy in the mean.
std::vector<float> factors_of(const std::vector<PointWindows>& points, const Line& line) {
    const std::size_t side = line.window.size();
    const auto reach = static_cast<std::ptrdiff_t>((side - 1) / 2);
    const float alone = factor_alone(line), wanted = static_cast<float>(line.hop);
    std::vector<float> factors(2 * static_cast<std::size_t>(reach) + 1, alone), shares(factors.size());
    std::vector<int> counts(factors.size());
    std::vector<Complex> sum;
    constexpr int rounds = 8;
    for (int round = 0; round < rounds; ++round) {
        std::ranges::fill(shares, 0.0f);
        std::ranges::fill(counts, 0);
        for (const PointWindows& point : points) {
            const auto factor = [&](std::size_t i) { return static_cast<std::size_t>(point.frequencies[i] + reach); };
            sum.assign(point.length, Complex(0));
            for (std::size_t i = 0; i < point.starts.size(); ++i)
                for (std::size_t p = 0; p < side; ++p)
                    sum[static_cast<std::size_t>(point.starts[i]) + p] +=
                        factors[factor(i)] * point.values[i * side + p];
            for (std::size_t i = 0; i < point.starts.size(); ++i) {
                float share = 0;
                for (std::size_t p = 0; p < side; ++p) {
                    const Complex a = point.values[i * side + p],
                                  b = sum[static_cast<std::size_t>(point.starts[i]) + p];
                    share += a.real() * b.real() + a.imag() * b.imag();
                }
                shares[factor(i)] += share;
                ++counts[factor(i)];
            }
        }
        for (std::size_t j = 0; j < factors.size(); ++j) {
            if (counts[j] == 0) continue;
            // A window alone has energy as the square of its factor, one among many in proportion to it: 0.7 lies
            // between both roots. A window that others nearly cancel would need an amplitude without bound.
            const float energy = factors[j] * shares[j] / static_cast<float>(counts[j]);
            factors[j] *= std::pow(wanted / std::max(energy, 0.25f * wanted), 0.7f);
            factors[j] = std::clamp(factors[j], 0.05f * alone, 2 * alone);
        }
    }
    return factors;
}

std::vector<float> factors_along(const Line& line, const Fan& fan, double depth_step, std::size_t steps) {
    const std::size_t reach = (line.window.size() - 1) / 2;
    std::vector<float> table((2 * reach + 1) * steps, factor_alone(line));
    // The last step stands for all larger depths, whose windows lie apart.
    for (std::size_t step = 0; step + 1 < steps; ++step) {
        const double depth = depth_step * (static_cast<double>(step) + 0.5);
        std::vector<PointWindows> points;
        for (int i = 0; i < line.offsets; ++i)
            points.push_back(windows_of_point(line, fan, depth, static_cast<double>(i) / line.offsets));
        const std::vector<float> factors = factors_of(points, line);
        for (std::size_t j = 0; j < factors.size(); ++j) table[j * steps + step] = factors[j];
    }
    return table;
}

}  // namespace

WindowBrightness::WindowBrightness(const LightFieldGrid& rays, const FieldGrid& grid, std::size_t hop,
                                   std::span<const float> window, double point_spacing)
    : reach_(static_cast<std::ptrdiff_t>((window.size() - 1) / 2)) {
    const double pitch = grid.plane.pitch_x, extent = static_cast<double>(window.size()) * pitch;
    const double depth_step = 1.25 * extent * extent / grid.wavelength / static_cast<double>(steps - 1);
    steps_a_metre_ = static_cast<float>(1 / depth_step);
    // Points that are 1 − 1/n hogels apart take n places.
    const int offsets = point_spacing < 1 ? static_cast<int>(std::lround(1 / (1 - point_spacing))) : 1;
    const Line line{window, hop, pitch, grid.wavelength, point_spacing, offsets};
    own_share_ = 1 / (factor_alone(line) * factor_alone(line));
    const auto slant = [](double other) { return std::sqrt(1 + other * other); };
    const Fan across{rays.center_u(), rays.half_u(), slant(rays.center_v())},
        down{rays.center_v(), rays.half_v(), slant(rays.center_u())};
    across_ = factors_along(line, across, depth_step, steps);
    down_ = down == across ? across_ : factors_along(line, down, depth_step, steps);
}

}  // namespace hogel::hologram::windows
