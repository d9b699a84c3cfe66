// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/eye/project.h"

#include <cmath>
#include <numbers>

namespace hogel::hologram::eye {
namespace {

using Complex = std::complex<float>;

// i for odd functions, whose samples in a band are imaginary.
Complex turn(std::size_t function) { return function % 2 == 0 ? Complex(1) : Complex(0, 1); }

}  // namespace

MiddlePhases::MiddlePhases(std::size_t samples) : re(padded(samples)), im(padded(samples)) {
    const auto n = static_cast<double>(samples);
    for (std::size_t m = 0; m < samples; ++m) {
        const double angle = std::numbers::pi * std::fmod(static_cast<double>(m) * (n - 1) / n, 2.0);
        re[m] = static_cast<float>(std::cos(angle));
        im[m] = static_cast<float>(std::sin(angle));
    }
}

void project_plain(const HogelBasis& basis, const MiddlePhases& middle, const HogelView& view, const float* waves,
                   const BandPlace& band) {
    const std::size_t n = basis.samples(), functions = basis.functions(), nodes = basis.nodes();
    const auto middle_phase = [&](std::size_t m) { return Complex(middle.re[m], middle.im[m]); };
    Array<Complex, 2> lines({n, functions});  // D_x applied: [row][function across]
    for (std::size_t row = 0; row < n; ++row)
        for (std::size_t column = 0; column < n; ++column) {
            const float* wave = waves + ((row / lanes * n + column) * 2) * lanes + row % lanes;
            const Complex value = Complex(wave[0], wave[lanes]) * middle_phase(row) * middle_phase(column);
            for (std::size_t k = 0; k < functions; ++k)
                lines(row, k) += view.columns.first[k * view.columns.stride + column] * value;
        }
    Array<Complex, 2> numbers({functions, functions});  // D_y applied, and the signs: [down][across]
    for (std::size_t l = 0; l < functions; ++l)
        for (std::size_t k = 0; k < functions; ++k) {
            for (std::size_t row = 0; row < n; ++row)
                numbers(l, k) += view.rows.first[l * view.rows.stride + row] * lines(row, k);
            numbers(l, k) *= view.columns.sign * view.rows.sign * turn(k) * turn(l);
        }
    const View<const float, 2> spread = basis.spread();
    for (std::size_t y = 0; y < nodes; ++y)
        for (std::size_t x = 0; x < nodes; ++x) {
            Complex sum = 0;
            for (std::size_t l = 0; l < functions; ++l)
                for (std::size_t k = 0; k < functions; ++k) sum += spread(y, l) * spread(x, k) * numbers(l, k);
            sum *= Complex(view.phases(y, 0, x), view.phases(y, 1, x));
            float* to = band.first + y * band.row + x;
            to[0] += sum.real();
            to[band.part] += sum.imag();
        }
}

}  // namespace hogel::hologram::eye
