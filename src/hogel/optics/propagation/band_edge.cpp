// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/propagation/band_edge.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "hogel/optics/phase_walk.h"

namespace hogel::optics::propagation {
namespace {

using DoubleComplex = std::complex<double>;
using std::numbers::pi;

// Returns the integral minus the trapezoidal rule at t.
DoubleComplex trapezoid_error(double t) {
    if (std::abs(t) < 1e-3) return DoubleComplex(0, -pi * t / 6);  // the first term of the series
    return DoubleComplex(0, -1) * (0.5 / (pi * t) - 0.5 / std::tan(pi * t));
}

// Solves a x = b by Gaussian elimination with row pivoting; `a` is row-major, n × n.
std::vector<DoubleComplex> solved(std::vector<DoubleComplex> a, std::vector<DoubleComplex> b) {
    const std::size_t n = b.size();
    for (std::size_t column = 0; column < n; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column + 1; row < n; ++row)
            if (std::abs(a[row * n + column]) > std::abs(a[pivot * n + column])) pivot = row;
        for (std::size_t i = 0; i < n; ++i) std::swap(a[column * n + i], a[pivot * n + i]);
        std::swap(b[column], b[pivot]);
        for (std::size_t row = column + 1; row < n; ++row) {
            const DoubleComplex factor = a[row * n + column] / a[column * n + column];
            for (std::size_t i = column; i < n; ++i) a[row * n + i] -= factor * a[column * n + i];
            b[row] -= factor * b[column];
        }
    }
    for (std::size_t row = n; row-- > 0;) {
        for (std::size_t i = row + 1; i < n; ++i) b[row] -= a[row * n + i] * b[i];
        b[row] /= a[row * n + row];
    }
    return b;
}

}  // namespace

BandEdge::BandEdge(double low, double high) {
    constexpr std::size_t count = 2 * max_beyond + 1, points = 300;
    constexpr double regularisation = 1e-12;
    const auto position = [&](std::size_t p) { return low + (high - low) * static_cast<double>(p) / (points - 1); };
    const auto wave = [](std::size_t k, double t) {
        return unit_phasor((static_cast<double>(k) - static_cast<double>(max_beyond)) * t);
    };
    // Normal equations of the least-squares fit.
    std::vector<DoubleComplex> a(count * count), b(count), waves(count);
    for (std::size_t p = 0; p < points; ++p) {
        for (std::size_t i = 0; i < count; ++i) waves[i] = wave(i, position(p));
        for (std::size_t i = 0; i < count; ++i) {
            b[i] += times(std::conj(waves[i]), trapezoid_error(position(p)));
            for (std::size_t j = 0; j < count; ++j) a[i * count + j] += times(std::conj(waves[i]), waves[j]);
        }
    }
    for (std::size_t i = 0; i < count; ++i) a[i * count + i] += regularisation * points;
    corrections = solved(a, b);
    double sum = 0;
    for (std::size_t p = 0; p < points; ++p) {
        DoubleComplex residual = trapezoid_error(position(p));
        for (std::size_t i = 0; i < count; ++i) residual -= corrections[i] * wave(i, position(p));
        sum += std::norm(residual);
    }
    error = std::sqrt(sum / points);
}

}  // namespace hogel::optics::propagation
