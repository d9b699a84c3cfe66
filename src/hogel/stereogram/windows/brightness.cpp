// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/windows/brightness.h"

#include <complex>
#include <numbers>
#include <optional>

#include "hogel/core/stop_scope.h"

namespace hogel::stereogram::windows {
namespace {

using Complex = std::complex<float>;

// Directions along one axis: centre and half width of their range of U or V, and the factor by which the path to the
// surface is longer because the fan is oblique along the other axis.
struct Fan {
    double center, half, slant;
    friend bool operator==(const Fan&, const Fan&) = default;
};

// Windows along one axis; hop in samples, lengths in metres.
struct Line {
    std::span<const float> window;
    std::size_t hop;
    double pitch, wavelength;
};

// Points 1 − 1/n hogels apart have n different offsets from the nearest hogel, evenly spaced.
const int point_offsets = static_cast<int>(std::lround(1 / (1 - point_spacing)));

// A direction of a window's transform along one axis.
struct Frequency {
    std::ptrdiff_t j;
    double sine, U;
};

std::vector<Frequency> frequencies_in(const Fan& fan, const Line& line) {
    const std::size_t side = line.window.size();
    const double step = line.wavelength / (static_cast<double>(side) * line.pitch);
    const auto max_index = static_cast<std::ptrdiff_t>((side - 1) / 2);
    std::vector<Frequency> found;
    for (std::ptrdiff_t j = -max_index; j <= max_index; ++j) {
        const double sine = step * static_cast<double>(j);
        if (std::abs(sine) >= 1) continue;
        const double U = -sine * fan.slant / std::sqrt(1 - sine * sine);
        if (std::abs(U - fan.center) <= fan.half) found.push_back({j, sine, U});
    }
    return found;
}

// Windows of one point. That of frequencies[i] begins at sample starts[i] of the sum; its values begin at i · side.
struct PointWindows {
    std::vector<std::ptrdiff_t> frequencies, starts;
    std::vector<Complex> values;
    std::size_t length = 0;  // of the sum, samples
};

// @param offset  of the point from a hogel, in hogels
PointWindows windows_of_point(const Line& line, const Fan& fan, double depth, double offset) {
    const std::size_t side = line.window.size();
    const double hop = static_cast<double>(line.hop) * line.pitch;
    PointWindows point;
    for (const auto& [j, sine, U] : frequencies_in(fan, line)) {
        const double position = offset - U * depth / hop, hops = std::round(position);
        if (std::abs(hops - position) > 0.5 * point_spacing) continue;  // no hogel has a ray nearest to this point
        const double path = std::hypot(depth * fan.slant, (hops - offset) * hop) - depth;
        point.frequencies.push_back(j);
        point.starts.push_back(static_cast<std::ptrdiff_t>(hops) * static_cast<std::ptrdiff_t>(line.hop));
        const double cycles_per_sample = static_cast<double>(j) / static_cast<double>(side);
        const double first = path / line.wavelength - 0.5 * static_cast<double>(side - 1) * cycles_per_sample;
        auto wave = std::polar(1.0, 2 * std::numbers::pi * (first - std::round(first)));
        const auto rotation = std::polar(1.0, 2 * std::numbers::pi * cycles_per_sample);
        for (const float weight : line.window) {
            point.values.push_back(static_cast<Complex>(wave) * weight);
            wave *= rotation;
        }
    }
    if (point.starts.empty()) return point;
    const auto [low, high] = std::ranges::minmax(point.starts);
    for (std::ptrdiff_t& start : point.starts) start -= low;
    point.length = static_cast<std::size_t>(high - low) + side;
    return point;
}

// Returns the factor of an isolated window. One begins at every hop, with the energy of `hop` samples of modulus 1.
float isolated_factor(const Line& line) {
    float energy = 0;
    for (const float weight : line.window) energy += weight * weight;
    return std::sqrt(static_cast<float>(line.hop) / energy);
}

// Returns the factors b_j by frequency, common to points of all these offsets: each window has the right mean energy.
std::vector<float> factors_of(const std::vector<PointWindows>& points, const Line& line) {
    const std::size_t side = line.window.size();
    const auto max_index = static_cast<std::ptrdiff_t>((side - 1) / 2);
    const float isolated = isolated_factor(line), target = static_cast<float>(line.hop);
    std::vector<float> factors(2 * static_cast<std::size_t>(max_index) + 1, isolated), shares(factors.size());
    std::vector<int> counts(factors.size());
    std::vector<Complex> sum;
    constexpr int rounds = 8;
    for (int round = 0; round < rounds; ++round) {
        std::ranges::fill(shares, 0.0f);
        std::ranges::fill(counts, 0);
        for (const PointWindows& point : points) {
            const auto factor = [&](std::size_t i) {
                return static_cast<std::size_t>(point.frequencies[i] + max_index);
            };
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
            // The energy of an isolated window is quadratic in its factor, that of one among many is linear: exponent
            // 0.7 lies between both roots. A window nearly cancelled by others would need an unbounded amplitude.
            const float energy = factors[j] * shares[j] / static_cast<float>(counts[j]);
            factors[j] *= std::pow(target / std::max(energy, 0.25f * target), 0.7f);
            factors[j] = std::clamp(factors[j], 0.05f * isolated, 2 * isolated);
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

// Uniform surface with one phase for all points.
class SmoothSurface {
  public:
    SmoothSurface(const Line& line, const Fan& fan) : line_(line), fan_(fan), frequencies_(frequencies_in(fan, line)) {
        const std::size_t side = line.window.size();
        for (const Frequency& frequency : frequencies_) {
            std::vector<std::complex<double>>& wave = waves_.emplace_back(line.hop);
            const double cycles_per_sample = static_cast<double>(frequency.j) / static_cast<double>(side);
            for (std::size_t p = 0; p < side; ++p)
                wave[p % line.hop] += std::polar(static_cast<double>(line.window[p]),
                                                 2 * std::numbers::pi * cycles_per_sample * static_cast<double>(p));
        }
    }

    // Returns the factor that gives the windows of the surface at a depth the power of the fan's rays. Without a depth
    // the phases of directions are unrelated.
    float factor(std::optional<double> depth) const {
        const double sines = sine_of(fan_.center + fan_.half) - sine_of(fan_.center - fan_.half);
        const auto side = static_cast<double>(line_.window.size()), hop = static_cast<double>(line_.hop);
        const double step = line_.wavelength / (side * line_.pitch);
        // Bounds the factor where windows cancel or the wave misses the fan.
        const double lower_bound = 0.0625 * (side / hop) * (side / hop);
        return static_cast<float>(std::sqrt(sines / step / std::max(depth ? power(*depth) : power(), lower_bound)));
    }

  private:
    static double sine_of(double tangent) { return tangent / std::sqrt(1 + tangent * tangent); }

    double power(double depth) const {
        std::vector<std::complex<double>> sum(line_.hop);
        for (std::size_t i = 0; i < waves_.size(); ++i) {
            const double sine = frequencies_[i].sine, path = (1 / std::sqrt(1 - sine * sine) - 1) * depth;
            // Phases are counted from the middle of the window.
            const double first = -0.5 * static_cast<double>(frequencies_[i].j) *
                                 static_cast<double>(line_.window.size() - 1) /
                                 static_cast<double>(line_.window.size());
            const auto phase = std::polar(1.0, 2 * std::numbers::pi * (path / line_.wavelength + first));
            for (std::size_t x = 0; x < line_.hop; ++x) sum[x] += phase * waves_[i][x];
        }
        return mean_power(sum);
    }
    double power() const {
        double sum = 0;
        for (const auto& wave : waves_) sum += mean_power(wave);
        return sum;
    }
    static double mean_power(std::span<const std::complex<double>> wave) {
        double sum = 0;
        for (const auto& sample : wave) sum += std::norm(sample);
        return sum / static_cast<double>(wave.size());
    }

    const Line& line_;
    const Fan& fan_;
    std::vector<Frequency> frequencies_;
    // One period (one hop) of the sum of a direction's waves under the windows of all hogels.
    std::vector<std::vector<std::complex<double>>> waves_;
};

std::vector<float> factors_along(const Line& line, const Fan& fan, double depth_step, PointPhases phases) {
    using Table = WindowBrightness;
    const std::size_t directions = 2 * ((line.window.size() - 1) / 2) + 1;
    std::vector<float> table(directions * Table::steps);
    std::optional<SmoothSurface> smooth;
    if (phases == PointPhases::fixed) smooth.emplace(line, fan);
    for (std::size_t step = 0; step < Table::steps; ++step) {
        core::throw_if_stopped();
        // The last step holds all larger depths, where the windows of a point are separate.
        std::optional<double> depth;
        if (step + 1 < Table::steps) depth = depth_step * (static_cast<double>(step) + 0.5);
        std::vector<float> factors(directions, isolated_factor(line));
        if (smooth)
            std::ranges::fill(factors, smooth->factor(depth));
        else if (depth)
            factors = rough_factors(line, fan, *depth);
        for (std::size_t j = 0; j < directions; ++j) table[j * Table::steps + step] = factors[j];
    }
    return table;
}

}  // namespace

WindowBrightness::WindowBrightness(const LightFieldGrid& rays, const FieldGrid& grid, std::size_t hop,
                                   std::span<const float> window, PointPhases phases)
    : max_frequency_(static_cast<std::ptrdiff_t>((window.size() - 1) / 2)) {
    const double pitch = grid.plane.pitch_x, extent = static_cast<double>(window.size()) * pitch;
    const double depth_step = 1.25 * extent * extent / grid.wavelength / static_cast<double>(steps - 1);
    steps_a_metre_ = static_cast<float>(1 / depth_step);
    const Line line{window, hop, pitch, grid.wavelength};
    isolated_share_ = 1 / (isolated_factor(line) * isolated_factor(line));
    const auto slant = [](double tangent) { return std::sqrt(1 + tangent * tangent); };
    const Fan across{rays.center_u(), rays.half_u(), slant(rays.center_v())},
        down{rays.center_v(), rays.half_v(), slant(rays.center_u())};
    across_ = factors_along(line, across, depth_step, phases);
    down_ = down == across ? across_ : factors_along(line, down, depth_step, phases);
}

}  // namespace hogel::stereogram::windows
