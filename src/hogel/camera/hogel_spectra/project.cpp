// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/project.h"

#include <cmath>
#include <numbers>

namespace hogel::camera::hogel_spectra {
namespace {

using Complex = std::complex<float>;

// Returns i for odd functions, which have imaginary samples in a band.
Complex odd_factor(std::size_t function) { return function % 2 == 0 ? Complex(1) : Complex(0, 1); }

}  // namespace

MiddlePhases::MiddlePhases(std::size_t rows, std::size_t columns)
    : rows_(rows), columns_(columns), factors_(padded(rows) * columns * 2) {
    const auto turns = [](std::size_t wave, std::size_t waves) {
        return static_cast<double>(wave) * static_cast<double>(waves - 1) / static_cast<double>(waves);
    };
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const double angle = std::numbers::pi * std::fmod(turns(row, rows) + turns(column, columns), 2.0);
            float* factor = &factors_[(row / lanes * columns + column) * 2 * lanes + row % lanes];
            factor[0] = static_cast<float>(std::cos(angle));
            factor[lanes] = static_cast<float>(std::sin(angle));
        }
}

void MiddlePhases::apply_plain(float* waves) const {
    for (std::size_t first = 0; first < factors_.size(); first += 2 * lanes)
        for (std::size_t i = first; i < first + lanes; ++i) {
            const Complex product = Complex(waves[i], waves[i + lanes]) * Complex(factors_[i], factors_[i + lanes]);
            waves[i] = product.real();
            waves[i + lanes] = product.imag();
        }
}

void project_plain(const SlepianBases& bases, const HogelView& view, const float* waves, const LineTarget& line) {
    const SlepianBasis &across = bases.across, &down = bases.down;
    const std::size_t rows = down.samples(), columns = across.samples(), nodes = across.nodes();
    Array<Complex, 2> sums({rows, across.functions()});  // D_x applied: [row][function across]
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns && view.in_band_rows.has_any(row / lanes * lanes, lanes, rows);
             ++column) {
            const float* wave = waves + ((row / lanes * columns + column) * 2) * lanes + row % lanes;
            const Complex value = Complex(wave[0], wave[lanes]);
            for (std::size_t k = 0; k < across.functions(); ++k)
                sums(row, k) += view.columns.first[k * view.columns.stride + column] * value;
        }
    for (std::size_t l = 0; l < down.functions(); ++l) {
        std::vector<Complex> numbers(across.functions());  // D_y applied, and the signs
        for (std::size_t k = 0; k < across.functions(); ++k) {
            for (std::size_t row = 0; row < rows; ++row)
                numbers[k] += view.rows.first[l * view.rows.stride + row] * sums(row, k);
            numbers[k] *= view.columns.sign * view.rows.sign * odd_factor(k) * odd_factor(l);
        }
        float *real = line.first + 2 * l * line.row, *imaginary = real + line.row;
        for (std::size_t x = 0; x < nodes; ++x) {
            Complex sum = 0;
            for (std::size_t k = 0; k < across.functions(); ++k) sum += across.spread()(x, k) * numbers[k];
            sum *= Complex(view.columns.carrier[x], view.columns.carrier[padded(nodes) + x]);
            real[x] += sum.real();
            imaginary[x] += sum.imag();
        }
    }
}

}  // namespace hogel::camera::hogel_spectra
