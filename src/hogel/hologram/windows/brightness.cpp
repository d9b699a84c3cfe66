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

// Points that are 1 − 1/n hogels apart take n places between hogels, evenly.
const int point_offsets = static_cast<int>(std::lround(1 / (1 - point_spacing)));

// A direction of a window's transform along one axis.
struct Frequency {
    std::ptrdiff_t j;
    double sine, U;
};

std::vector<Frequency> frequencies_in(const Fan& fan, const Line& line) {
    const std::size_t side = line.window.size();
    const double step = line.wavelength / (static_cast<double>(side) * line.pitch);
    const auto reach = static_cast<std::ptrdiff_t>((side - 1) / 2);
    std::vector<Frequency> found;
    for (std::ptrdiff_t j = -reach; j <= reach; ++j) {
        const double sine = step * static_cast<double>(j);
        if (std::abs(sine) >= 1) continue;
        const double U = -sine * fan.slant / std::sqrt(1 - sine * sine);
        if (std::abs(U - fan.center) <= fan.half) found.push_back({j, sine, U});
    }
    return found;
}

// The windows of one point: that of frequency j begins at sample starts[i] of the sum and has the values from i · side.
struct PointWindows {
    std::vector<std::ptrdiff_t> frequencies, starts;
    std::vector<Complex> values;
    std::size_t length = 0;  // of their sum
};

// @param offset  of the point from a hogel, in hogels
PointWindows windows_of_point(const Line& line, const Fan& fan, double depth, double offset) {
    const std::size_t side = line.window.size();
    const double hop = static_cast<double>(line.hop) * line.pitch;
    PointWindows point;
    for (const auto& [j, sine, U] : frequencies_in(fan, line)) {
        const double met = offset - U * depth / hop, hops = std::round(met);
        if (std::abs(hops - met) > 0.5 * point_spacing) continue;  // a ray of no hogel is nearest to this point
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

std::vector<float> rough_factors(const Line& line, const Fan& fan, double depth) {
    std::vector<PointWindows> points;
    for (int i = 0; i < point_offsets; ++i)
        points.push_back(windows_of_point(line, fan, depth, static_cast<double>(i) / point_offsets));
    return factors_of(points, line);
}

// The factor with which the windows of a uniform surface, whose points have one phase, add up to a plane wave of the
// fan's power. A direction contributes the mean of its wave under the window, ŵ_j = Σ_p w_p exp(2πi j p/side)/hop,
// which is nonzero at frequency 0 and its neighbours. Their phases depend on the depth; far away they are unrelated.
float smooth_factor(const Line& line, const Fan& fan, double depth) {
    const auto side = static_cast<double>(line.window.size());
    std::complex<double> sum = 0;
    double power = 0;
    for (const Frequency& frequency : frequencies_in(fan, line)) {
        double mean = 0;
        for (std::size_t p = 0; p < line.window.size(); ++p)
            mean +=
                static_cast<double>(line.window[p]) * std::cos(2 * std::numbers::pi * static_cast<double>(frequency.j) *
                                                               (static_cast<double>(p) - 0.5 * (side - 1)) / side);
        mean /= static_cast<double>(line.hop);
        const double path = (1 / std::sqrt(1 - frequency.sine * frequency.sine) - 1) * depth;
        if (std::isfinite(depth)) sum += std::polar(mean, 2 * std::numbers::pi * path / line.wavelength);
        power += mean * mean;
    }
    const auto sine_of = [](double tangent) { return tangent / std::sqrt(1 + tangent * tangent); };
    const double width = sine_of(fan.center + fan.half) - sine_of(fan.center - fan.half);
    const double step = line.wavelength / (side * line.pitch);
    // Where windows cancel, or the wave misses the fan, the factor would have no bound.
    const double lower_bound = 0.25 * side / static_cast<double>(line.hop);
    return static_cast<float>(std::sqrt(width / step) /
                              std::max(std::isfinite(depth) ? std::abs(sum) : std::sqrt(power), lower_bound));
}

std::vector<float> factors_along(const Line& line, const Fan& fan, double depth_step, PointPhases phases) {
    using Table = WindowBrightness;
    const std::size_t directions = 2 * ((line.window.size() - 1) / 2) + 1;
    std::vector<float> table(directions * Table::steps);
    for (std::size_t step = 0; step < Table::steps; ++step) {
        // The last step stands for all larger depths, where the windows of one point lie apart.
        const bool is_last = step + 1 == Table::steps;
        const double depth = is_last ? HUGE_VAL : depth_step * (static_cast<double>(step) + 0.5);
        std::vector<float> factors(directions, factor_alone(line));
        if (phases == PointPhases::fixed)
            std::ranges::fill(factors, smooth_factor(line, fan, depth));
        else if (!is_last)
            factors = rough_factors(line, fan, depth);
        for (std::size_t j = 0; j < directions; ++j) table[j * Table::steps + step] = factors[j];
    }
    return table;
}

}  // namespace

WindowBrightness::WindowBrightness(const LightFieldGrid& rays, const FieldGrid& grid, std::size_t hop,
                                   std::span<const float> window, PointPhases phases)
    : reach_(static_cast<std::ptrdiff_t>((window.size() - 1) / 2)) {
    const double pitch = grid.plane.pitch_x, extent = static_cast<double>(window.size()) * pitch;
    const double depth_step = 1.25 * extent * extent / grid.wavelength / static_cast<double>(steps - 1);
    steps_a_metre_ = static_cast<float>(1 / depth_step);
    const Line line{window, hop, pitch, grid.wavelength};
    own_share_ = 1 / (factor_alone(line) * factor_alone(line));
    const auto slant = [](double other) { return std::sqrt(1 + other * other); };
    const Fan across{rays.center_u(), rays.half_u(), slant(rays.center_v())},
        down{rays.center_v(), rays.half_v(), slant(rays.center_u())};
    across_ = factors_along(line, across, depth_step, phases);
    down_ = down == across ? across_ : factors_along(line, down, depth_step, phases);
}

}  // namespace hogel::hologram::windows
