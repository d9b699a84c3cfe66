// SPDX-License-Identifier: Apache-2.0
#include "hogel/direct/fresnel_integral.h"

#include <array>
#include <cmath>
#include <numbers>

namespace hogel::direct {
namespace {

using DoubleComplex = std::complex<double>;

constexpr double table_end = 8;
constexpr int steps_per_unit = 128, entries = static_cast<int>(table_end) * steps_per_unit + 1;

DoubleComplex slope(double w) { return std::polar(1.0, 0.5 * std::numbers::pi * w * w); }

struct Entry {
    DoubleComplex value, slope;
};

const std::array<Entry, entries>& table() {
    static const auto entries_by_step = [] {
        std::array<Entry, entries> all;
        for (int i = 0; i < entries; ++i) {
            const double w = static_cast<double>(i) / steps_per_unit;
            all[static_cast<std::size_t>(i)] = {fresnel_integral_plain(w),
                                                slope(w) / static_cast<double>(steps_per_unit)};
        }
        return all;
    }();
    return entries_by_step;
}

}  // namespace

std::complex<double> fresnel_integral_plain(double w) {
    const double x = std::abs(w);
    DoubleComplex value;
    if (x < 1.6) {
        // Σ (iπ/2)^n w^{2n+1} / (n! (2n+1))
        DoubleComplex term = x;
        const DoubleComplex factor(0, 0.5 * std::numbers::pi * x * x);
        for (int n = 0; n < 60; ++n) {
            value += term / double(2 * n + 1);
            term *= factor / double(n + 1);
        }
    } else {
        // (1+i)/2 · erf z, z = (1−i)√π x/2; erfc z = e^{−z²}/√π · 1/(z + (1/2)/(z + 1/(z + (3/2)/(z + …))))
        const DoubleComplex z = 0.5 * std::sqrt(std::numbers::pi) * x * DoubleComplex(1, -1);
        DoubleComplex fraction = z;
        for (int n = 60; n > 0; --n) fraction = z + 0.5 * n / fraction;
        const DoubleComplex erfc =
            std::polar(1.0, 0.5 * std::numbers::pi * x * x) / (std::sqrt(std::numbers::pi) * fraction);
        value = DoubleComplex(0.5, 0.5) * (1.0 - erfc);
    }
    return w < 0 ? -value : value;
}

std::complex<double> fresnel_integral(double w) {
    const double x = std::abs(w);
    DoubleComplex value;
    if (x < table_end - 1.0 / steps_per_unit) {
        const double position = x * steps_per_unit, floor = std::floor(position), t = position - floor;
        const Entry* const entry = &table()[static_cast<std::size_t>(floor)];
        const DoubleComplex rise = entry[1].value - entry[0].value;
        // Cubic Hermite interpolation from two values and slopes.
        value = entry[0].value + t * (entry[0].slope + t * (3.0 * rise - 2.0 * entry[0].slope - entry[1].slope +
                                                            t * (entry[0].slope + entry[1].slope - 2.0 * rise)));
    } else {
        // (1+i)/2 + e^{iπx²/2}/(iπx) · (1 + q + 3q² + 15q³ + …), q = 1/(iπx²), by repeated integration by parts.
        const DoubleComplex q(0, -1 / (std::numbers::pi * x * x));
        value = DoubleComplex(0.5, 0.5) + slope(x) * q * x * (1.0 + q * (1.0 + q * (3.0 + 15.0 * q)));
    }
    return w < 0 ? -value : value;
}

}  // namespace hogel::direct
