// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/optics/lines.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/optics/spectrum.h"
#include "hogel/work/parallel.h"

namespace hogel::optics {
namespace {

using Complex = std::complex<float>;

// Returns the fade-out weight: 1 up to `reach`, 0 beyond reach + fade, smooth in between.
double fade_weight(double distance, double reach, double fade) {
    if (distance <= reach) return 1;
    if (distance >= reach + fade) return 0;
    const double c = std::cos(0.5 * std::numbers::pi * (distance - reach) / fade);
    return c * c;
}

class DirectionRow {
  public:
    DirectionRow(const Spectrum& spectrum, const PropagationOptions& options, double row)
        : spectrum_(spectrum),
          options_(options),
          frequency_(1 / spectrum.wavelength),
          fy_(spectrum.frequency_y(row)),
          reach_x_(options.reach_x > 0 ? options.reach_x : 0.5 * spectrum.window.size_x()),
          reach_y_(options.reach_y > 0 ? options.reach_y : 0.5 * spectrum.window.size_y()) {}

    // Returns the propagation phase of a direction, in cycles.
    double cycles(double column) const {
        return along_z(column) * options_.distance + fx(column) * options_.shift_x + fy_ * options_.shift_y;
    }

    // Returns a bound on the deviation of the phase over `count` columns from the parabola through both ends and the
    // middle, in cycles: the third derivative, at most 3 z f_x f_z⁻⁵/λ², times 0.065 times the cube of half the range.
    double phase_deviation(double column, double count) const {
        const double fz = std::min(along_z(column), along_z(column + count));
        const double steepest = std::max(std::abs(fx(column)), std::abs(fx(column + count)));
        const double half = 0.5 * count / spectrum_.window.size_x();
        return 0.2 * std::abs(options_.distance) * steepest * frequency_ * frequency_ / std::pow(fz, 5) * half * half *
               half;
    }

    // Returns the fraction of a direction's amplitude that is kept.
    double kept_fraction(double column) const {
        const double fz = along_z(column);
        if (fz <= 0) return 0;
        return fade_weight(std::abs(aside_x(column, fz)), reach_x_, options_.fade_x) *
               fade_weight(std::abs(aside_y(fz)), reach_y_, options_.fade_y);
    }

    // The sideways path is monotonic between two columns on the same side of f_x = 0. If both ends are kept, all
    // columns in between are kept; if both are dropped on the same side, all are dropped.
    enum class Kept { whole, partly, none };
    Kept between(double first, double last) const {
        const double fz0 = along_z(first), fz1 = along_z(last);
        if (fx(first) * fx(last) < 0 || fz0 <= 0 || fz1 <= 0) return Kept::partly;
        const auto [left, right] = std::minmax({aside_x(first, fz0), aside_x(last, fz1)});
        const auto [low, high] = std::minmax({aside_y(fz0), aside_y(fz1)});
        const double end_x = reach_x_ + options_.fade_x, end_y = reach_y_ + options_.fade_y;
        if (left > end_x || right < -end_x || low > end_y || high < -end_y) return Kept::none;
        const bool whole = left >= -reach_x_ && right <= reach_x_ && low >= -reach_y_ && high <= reach_y_;
        return whole ? Kept::whole : Kept::partly;
    }

  private:
    double fx(double column) const { return spectrum_.frequency_x(column); }
    double along_z(double column) const {
        return std::sqrt(std::max(frequency_ * frequency_ - fx(column) * fx(column) - fy_ * fy_, 0.0));
    }
    // Sideways path, relative to the window's shift.
    double aside_x(double column, double fz) const { return options_.distance * fx(column) / fz - options_.shift_x; }
    double aside_y(double fz) const { return options_.distance * fy_ / fz - options_.shift_y; }

    const Spectrum& spectrum_;
    const PropagationOptions& options_;
    double frequency_, fy_, reach_x_, reach_y_;
};

// Phases are continued from the first direction of each segment. A block of columns that begins at a multiple of the
// segment therefore gives the same samples as a whole row.
constexpr std::size_t segment = 32;
static_assert(spectrum_block_columns % segment == 0);

// Propagates the samples of a row, beginning with column `first`.
void propagate_row(std::span<Complex> samples, std::size_t first, const DirectionRow& row) {
    using Kept = DirectionRow::Kept;
    constexpr double max_deviation = 1e-4;  // cycles
    for (std::size_t begin = 0; begin < samples.size(); begin += segment) {
        const std::size_t count = std::min(segment, samples.size() - begin);
        const double start = static_cast<double>(first + begin);
        const Kept kept = row.between(start, start + static_cast<double>(count - 1));
        if (kept == Kept::none) {
            std::ranges::fill(samples.subspan(begin, count), Complex(0));
            continue;
        }
        const auto times_phase = [&](std::size_t i, std::complex<double> phase) {
            Complex& value = samples[begin + i];
            const double fraction = kept == Kept::whole ? 1 : row.kept_fraction(start + static_cast<double>(i));
            value = fraction > 0 ? Complex(fraction * times(std::complex<double>(value), phase)) : 0;
        };
        if (row.phase_deviation(start, segment) < max_deviation) {
            walk_phase(
                count, [&](double step) { return row.cycles(start + step); }, times_phase);
        } else {
            for (std::size_t i = 0; i < count; ++i)
                times_phase(i, unit_phasor(row.cycles(start + static_cast<double>(i))));
        }
    }
}

}  // namespace

void propagate(Spectrum& spectrum, const PropagationOptions& options) {
    const distributed::LineRange local = spectrum.samples.local_columns();
    work::parallel_for(local.count > 0 ? blocks_of(spectrum.height()) : 0, [&](std::size_t block) {
        for (std::size_t r = block * block_lines; r < std::min((block + 1) * block_lines, spectrum.height()); ++r)
            propagate_row({&spectrum.samples.at(r, local.first), local.count}, local.first,
                          DirectionRow(spectrum, options, static_cast<double>(r)));
    });
    spectrum.window.center_x += options.shift_x;
    spectrum.window.center_y += options.shift_y;
}

}  // namespace hogel::optics
