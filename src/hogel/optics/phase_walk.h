// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace hogel::optics {

/// Returns e^{2πi cycles} for any number of cycles, also negative and large ones.
inline std::complex<double> unit_phasor(double cycles) {
    return std::polar(1.0, 2 * std::numbers::pi * (cycles - std::floor(cycles)));
}

/// Returns the product, without the handling of infinities in std::complex.
template <class T>
std::complex<T> times(std::complex<T> a, std::complex<T> b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Calls emit(i, e^{2πi cycles(i)}) for i = 0 … count − 1. Evaluates cycles() at the ends and the middle of every 32
/// steps, and continues by differences: over 32 steps it must equal a parabola to far below a thousandth of a cycle.
template <class Cycles, class Emit>
void walk_phase(std::size_t count, const Cycles& cycles, const Emit& emit) {
    constexpr std::size_t segment = 32;
    for (std::size_t begin = 0; begin < count; begin += segment) {
        const double start = static_cast<double>(begin);
        const double t0 = cycles(start), t1 = cycles(start + 0.5 * segment), t2 = cycles(start + segment);
        const double curvature = (t2 - 2 * t1 + t0) / (0.25 * segment * segment);
        const double slope = (t2 - t0) / segment - 0.5 * curvature * segment;
        std::complex<double> value = unit_phasor(t0), step = unit_phasor(slope + 0.5 * curvature);
        const std::complex<double> step_change = unit_phasor(curvature);
        for (std::size_t i = begin; i < std::min(begin + segment, count); ++i) {
            emit(i, value);
            value = times(value, step);
            step = times(step, step_change);
        }
    }
}

}  // namespace hogel::optics
