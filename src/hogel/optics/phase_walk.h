// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace hogel::optics {

/// e^{2πi cycles} for any number of cycles, also negative and large ones.
inline std::complex<double> unit_phasor(double cycles) {
    return std::polar(1.0, 2 * std::numbers::pi * (cycles - std::floor(cycles)));
}

/// The product without the treatment of infinities in std::complex.
template <class T>
std::complex<T> times(std::complex<T> a, std::complex<T> b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Calls emit(i, e^{2πi cycles(i)}) for i = 0 … count − 1. cycles(step) must equal a parabola over any 32 steps to far
/// below a thousandth of a cycle: it is evaluated only at their ends and middle and continued by differences in
/// between.
template <class Cycles, class Emit>
void walk_phase(std::size_t count, const Cycles& cycles, const Emit& emit) {
    constexpr std::size_t stretch = 32;
    for (std::size_t begin = 0; begin < count; begin += stretch) {
        const double at = static_cast<double>(begin);
        const double t0 = cycles(at), t1 = cycles(at + 0.5 * stretch), t2 = cycles(at + stretch);
        const double curvature = (t2 - 2 * t1 + t0) / (0.25 * stretch * stretch);
        const double slope = (t2 - t0) / stretch - 0.5 * curvature * stretch;
        std::complex<double> value = unit_phasor(t0), step = unit_phasor(slope + 0.5 * curvature);
        const std::complex<double> bend = unit_phasor(curvature);
        for (std::size_t i = begin; i < std::min(begin + stretch, count); ++i) {
            emit(i, value);
            value = times(value, step);
            step = times(step, bend);
        }
    }
}

}  // namespace hogel::optics
