// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/pupil_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/math/bessel.h"

namespace hogel::optics {
namespace {

// Kaiser's β for a window ripple of 2·10⁻³.
constexpr double beta = 5;

}  // namespace

SpreadWindow::SpreadWindow(double span_x, double span_y, double blur, double cell) {
    constexpr double max_cells = 128, min_fade = 40;
    spot = 0.5 * blur;
    flat = spot + std::min(std::hypot(span_x, span_y), max_cells * cell);
    stop = flat + std::max(0.5 * std::min(flat, max_cells * cell), min_fade * cell);
}

void SpreadWindow::fit(double room) {
    if (stop <= room) return;
    flat *= room / stop;
    stop = room;
}

double light_left_out(const SpreadWindow& window, double span_x, double span_y, double cell) {
    const auto fraction_beyond = [&](double sines) {
        return 2 / (std::numbers::pi * std::numbers::pi * std::max(sines / cell, 1.0));
    };
    return std::max(0.0, fraction_beyond(0.5 * (window.flat + window.stop) - window.spot) -
                             fraction_beyond(0.25 * (span_x + span_y)));
}

PupilEdge::PupilEdge(const SpreadWindow& window, double wavelength) {
    // In cycles per metre of the pupil.
    const double middle = 0.5 * (window.flat + window.stop) / wavelength,
                 fade = (window.stop - window.flat) / wavelength;
    reach_ = std::sqrt(1 + beta * beta / (std::numbers::pi * std::numbers::pi)) / fade;
    const auto cycles = 2 * reach_ * middle;
    const std::size_t steps = 256 * static_cast<std::size_t>(std::ceil(cycles + 4));
    scale_ = static_cast<double>(steps) / (2 * reach_);
    // Integrates sin(2π·middle·u)/(πu) times the Kaiser window by the midpoint rule.
    table_.resize(steps + 1);
    for (std::size_t i = 0; i < steps; ++i) {
        const double u = (static_cast<double>(i) + 0.5) / scale_ - reach_, x = u / reach_;
        const double phase = 2 * std::numbers::pi * middle * u;
        const double sinc = std::abs(phase) < 1e-9 ? 1 : std::sin(phase) / phase;
        table_[i + 1] = table_[i] + sinc * math::bessel_i0(beta * std::sqrt(std::max(0.0, 1 - x * x)));
    }
    for (double& value : table_) value /= table_.back();
}

}  // namespace hogel::optics
