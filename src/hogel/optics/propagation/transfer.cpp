// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/propagation/transfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hogel/optics/phase_walk.h"
#include "hogel/optics/propagation/band_edge.h"

namespace hogel::optics::propagation {
namespace {

using Complex = std::complex<float>;

// Returns the quadrature weights of an axis over its band. Adds the squared error at the edges to `square`.
std::vector<std::complex<double>> weights_of(const AxisPlan& axis, double& square) {
    const double half = std::round(0.5 * axis.period / axis.field.step);
    const double first = std::round(axis.frequencies.first * axis.period);
    std::vector<std::complex<double>> weights(axis.frequencies.count);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double beyond = std::abs(first + static_cast<double>(i)) - half;
        weights[i] = beyond < 0 ? 1 : beyond == 0 ? 0.5 : 0;
    }
    const auto correct = [&](const AxisPlan::Edge& edge, int side) {
        if (!edge.active) return;
        const BandEdge rule = side > 0 ? BandEdge(edge.low, edge.high) : BandEdge(-edge.high, -edge.low);
        for (std::size_t c = 0; c < rule.corrections.size(); ++c) {
            const double k = static_cast<double>(c) - static_cast<double>(BandEdge::max_beyond);
            const double index = side * (half + k) - first;
            if (index >= 0 && index < static_cast<double>(weights.size()))
                weights[static_cast<std::size_t>(index)] += rule.corrections[c];
        }
        // A sample adds 1/(2 half) of the error to another sample; the errors of a line add up as noise.
        square += static_cast<double>(axis.field.count) * rule.error * rule.error / (4 * half * half);
    };
    correct(axis.lower, -1);
    correct(axis.upper, 1);
    return weights;
}

// Returns the fraction of the amplitude that is kept for a sideways path.
double kept_amplitude(const AxisPlan& axis, double path) {
    if (axis.fresnel == 0) return 1;
    const double width = axis.fresnel * std::numbers::inv_sqrtpi;
    const double excess = std::abs(path - axis.middle) - axis.reach - 0.5 * axis.guard;
    const double end = axis.end_of_fade() - 0.5 * axis.guard;
    return excess <= -end ? 1 : excess >= end ? 0 : 0.5 * std::erfc(excess / width);
}

}  // namespace

// A column of frequencies: one f_x, all f_y.
class Transfer::Column {
  public:
    Column(const TilePlan& plan, std::size_t column)
        : plan_(plan),
          fx_(plan.x.frequencies.first + static_cast<double>(column) * plan.x.frequencies.step),
          square_(1 / (plan.wavelength * plan.wavelength) - fx_ * fx_) {}

    double fy(double row) const { return plan_.y.frequencies.first + row * plan_.y.frequencies.step; }
    double square(double row) const { return square_ - fy(row) * fy(row); }
    double along_z(double row) const { return std::sqrt(std::max(square(row), 0.0)); }
    double path_x(double fz) const { return plan_.distance * fx_ / fz; }
    double path_y(double row, double fz) const { return plan_.distance * fy(row) / fz; }

    // Returns a bound on the deviation of f_z z over `count` rows from the parabola through both ends and the middle,
    // cycles: the third derivative, at most 3 z f_y f_z⁻⁵/λ², times 0.065 times the cube of half the range.
    double phase_deviation(double row, double count) const {
        const double fz = std::min(along_z(row), along_z(row + count));
        const double steepest = std::max(std::abs(fy(row)), std::abs(fy(row + count)));
        const double half = 0.5 * count * plan_.y.frequencies.step;
        return 0.2 * std::abs(plan_.distance) * steepest * half * half * half /
               (plan_.wavelength * plan_.wavelength * std::pow(fz, 5));
    }

    enum class Kept { whole, partly, none };
    // Paths are monotonic between two rows on the same side of f_y = 0: the paths at both ends bound all others.
    Kept between(double first, double last) const {
        if (fy(first) * fy(last) < 0 || square(first) <= 0 || square(last) <= 0) return Kept::partly;
        const double fz0 = along_z(first), fz1 = along_z(last);
        const auto side = [](const AxisPlan& axis, std::pair<double, double> paths) {
            if (axis.fresnel == 0) return Kept::whole;
            const double low = std::min(paths.first, paths.second) - axis.middle;
            const double high = std::max(paths.first, paths.second) - axis.middle;
            const double full = axis.reach + axis.guard - axis.end_of_fade();
            if (low >= axis.outermost() || high <= -axis.outermost()) return Kept::none;
            return low >= -full && high <= full ? Kept::whole : Kept::partly;
        };
        const Kept x = side(plan_.x, {path_x(fz0), path_x(fz1)});
        const Kept y = side(plan_.y, {path_y(first, fz0), path_y(last, fz1)});
        if (x == Kept::none || y == Kept::none) return Kept::none;
        return x == Kept::whole && y == Kept::whole ? Kept::whole : Kept::partly;
    }

    // Returns the kept fraction of the amplitude of a propagating direction.
    double kept_part(double row) const {
        const double fz = along_z(row);
        return fz > 0 ? kept_amplitude(plan_.x, path_x(fz)) * kept_amplitude(plan_.y, path_y(row, fz)) : 0;
    }

    std::complex<double> factor(double row) const {
        if (const double s = square(row); s <= 0)
            return plan_.evanescent ? std::exp(-2 * std::numbers::pi * std::sqrt(-s) * plan_.distance) : 0;
        const double amplitude = kept_part(row);
        return amplitude > 0 ? amplitude * unit_phasor(along_z(row) * plan_.distance) : 0;
    }

  private:
    const TilePlan& plan_;
    double fx_, square_;
};

Transfer::Transfer(const TilePlan& plan) : plan_(plan) {
    constexpr double fade = 1e-5, rounding = 2e-6;
    double square = fade * fade + rounding * rounding;
    weights_x_ = weights_of(plan.x, square);
    weights_y_ = weights_of(plan.y, square);
    error_ = std::sqrt(square);
}

void Transfer::multiply(std::size_t column, std::span<Complex> values) const {
    constexpr std::size_t segment = 32;     // as in walk_phase()
    constexpr double max_deviation = 1e-4;  // cycles
    const Column along(plan_, column);
    const std::complex<double> weight = weights_x_[column];
    const auto set = [&](std::size_t row, std::complex<double> factor) {
        values[row] = Complex(times(std::complex<double>(values[row]), times(times(weight, weights_y_[row]), factor)));
    };
    for (std::size_t begin = 0; begin < values.size(); begin += segment) {
        const std::size_t count = std::min(segment, values.size() - begin);
        const double start = static_cast<double>(begin);
        const Column::Kept kept = along.between(start, start + static_cast<double>(count - 1));
        if (kept == Column::Kept::none) {
            std::ranges::fill(values.subspan(begin, count), Complex(0));
        } else if (kept == Column::Kept::whole && along.square(start + segment) > 0 &&
                   along.phase_deviation(start, segment) < max_deviation) {
            walk_phase(
                count, [&](double step) { return along.along_z(start + step) * plan_.distance; },
                [&](std::size_t i, std::complex<double> phase) { set(begin + i, phase); });
        } else {
            for (std::size_t i = 0; i < count; ++i) set(begin + i, along.factor(start + static_cast<double>(i)));
        }
    }
}

Transfer::Energy Transfer::energy(std::size_t column, std::span<const Complex> values) const {
    const Column along(plan_, column);
    const double min_fz = plan_.min_cosine / plan_.wavelength;
    Energy energy;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double square = along.square(static_cast<double>(i)), value = std::norm(std::complex<double>(values[i]));
        energy.all += value;
        if (square > 0 && square < min_fz * min_fz) energy.grazing += value;
    }
    return energy;
}

}  // namespace hogel::optics::propagation
