// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "hogel/core/parallel.h"
#include "hogel/hologram/patterns/pattern_parts.h"

namespace hogel::hologram::patterns {
namespace {

using Complex = std::complex<float>;

// A frequency of a square has light if its mean is more than this share of the largest.
constexpr double lit_share = 0.05;

// The mean power of each frequency in squares side by side.
std::vector<double> mean_power(View<const Complex, 2> field, std::size_t side) {
    const math::Fft2 fft(side, side);
    const std::size_t rows = field.extent(0) / side, columns = field.extent(1) / side;
    std::vector<std::vector<double>> power(rows, std::vector<double>(side * side));
    core::parallel_for(rows, [&](std::size_t j) {
        Array<Complex, 2> square({side, side});
        for (std::size_t i = 0; i < columns; ++i) {
            for (std::size_t y = 0; y < side; ++y) std::copy_n(&field(j * side + y, i * side), side, &square(y, 0));
            fft.forward(square);
            for (std::size_t f = 0; f < square.size(); ++f) power[j][f] += std::norm(square.data()[f]);
        }
    });
    std::vector<double> mean(side * side);
    for (const std::vector<double>& row : power)
        for (std::size_t f = 0; f < mean.size(); ++f) mean[f] += row[f];
    return mean;
}

// Whether each frequency of a square belongs to the band: those with light and their neighbours, because an aperture is
// not that sharp, and a lens beside the light field sees what is next to it.
std::vector<bool> lit_frequencies(View<const Complex, 2> field, std::size_t side) {
    const std::vector<double> power = mean_power(field, side);
    const double threshold = lit_share * *std::ranges::max_element(power);
    std::vector<bool> lit(power.size());
    for (std::size_t q = 0; q < side; ++q)
        for (std::size_t p = 0; p < side; ++p) {
            if (!(power[q * side + p] > threshold)) continue;
            for (const std::size_t row : {q + side - 1, q, q + 1})
                for (const std::size_t column : {p + side - 1, p, p + 1}) lit[row % side * side + column % side] = true;
        }
    return lit;
}

// The frequency of a square of `side` samples that is next to frequency k of a line of `length`.
std::size_t coarse(std::size_t k, std::size_t length, std::size_t side) {
    return (2 * k * side + length) / (2 * length) % side;
}

}  // namespace

FieldBand::FieldBand(View<const Complex, 2> field, std::size_t side)
    : fft_(field.extent(0), field.extent(1)), wanted_(field.shape()) {
    side = std::min({side, field.extent(0), field.extent(1)});
    const std::vector<bool> bands = lit_frequencies(field, side);
    std::copy_n(field.data(), field.size(), wanted_.data());
    fft_.forward(wanted_);
    const std::size_t rows = field.extent(0), columns = field.extent(1);
    lit_.resize(rows * columns);
    std::vector<double> energy(rows);
    core::parallel_for(rows, [&](std::size_t y) {
        for (std::size_t x = 0; x < columns; ++x) {
            const bool lit = bands[coarse(y, rows, side) * side + coarse(x, columns, side)];
            lit_[y * columns + x] = lit ? 1 : 0;
            if (!lit) wanted_(y, x) = 0;
            energy[y] += std::norm(wanted_(y, x));
        }
    });
    for (const double row : energy) energy_ += row;
}

FieldBand::Match FieldBand::match(Array<Complex, 2>& shown) const {
    fft_.forward(shown);
    return match(sum_of_lines(shown.extent(0), nullptr, [&](std::size_t y) {
        Sums row;
        for (std::size_t x = 0; x < shown.extent(1); ++x) add(y, x, shown(y, x), row);
        return row;
    }));
}

FieldBand::Match FieldBand::match(const Sums& sums) const {
    Match match;
    if (!(sums.energy > 0 && energy_ > 0)) return match;
    match.error = std::max(0.0, 1 - std::norm(sums.product) / (sums.energy * energy_));
    match.scale = std::conj(sums.product) / sums.energy;
    match.slope = Complex(2.0 * std::conj(match.scale) / energy_);
    return match;
}

}  // namespace hogel::hologram::patterns
