// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/lanes.h"

#include <complex>

#include "hogel/core/half.h"

namespace hogel::camera::hogel_spectra {

namespace {

using Complex = std::complex<float>;

// Returns the sum of value(wave) over the waves of all pairs.
template <class Value>
float sum_of(const SlepianBasis::Weights& weights, const Value& value) {
    float sum = 0;
    for (const SlepianBasis::SymmetricPair& pair : weights.pairs) {
        sum += value(pair.first);
        if (pair.second != pair.first) sum += value(pair.second);
    }
    return sum;
}

template <class Value>
void sum_columns(const SlepianBasis& basis, const SlepianBasis::Weights& columns, const Value& value, float* line) {
    for (std::size_t k = 0; k < basis.functions(); ++k)
        for (std::size_t i = 0; i < 2 * lanes; ++i) {
            const float* weights = columns.first + k * columns.stride;
            const float sum =
                sum_of(columns, [&](std::size_t wave) { return weights[wave] * value(wave * 2 * lanes + i); });
            line[k * 2 * lanes + i] = sum;
        }
}

// Returns the number of a lane at node x of function l down.
Complex node_of_lane(const SlepianBasis& basis, const float* numbers, const float* carrier, std::size_t lane,
                     std::size_t l, std::size_t x) {
    const auto odd_factor = [](std::size_t function) { return function % 2 == 0 ? Complex(1) : Complex(0, 1); };
    Complex sum = 0;
    for (std::size_t k = 0; k < basis.functions(); ++k) {
        const float* number = numbers + (l * basis.functions() + k) * 2 * lanes + lane;
        sum += basis.spread()(x, k) * odd_factor(k) * odd_factor(l) * Complex(number[0], number[lanes]);
    }
    return sum * Complex(carrier[x], carrier[padded(basis.nodes()) + x]);
}

}  // namespace

void sum_row_plain(const SlepianBasis& basis, const SlepianBasis::Weights& columns, const float* waves, float* line) {
    sum_columns(
        basis, columns, [&](std::size_t i) { return waves[i]; }, line);
}

void sum_row_of_halves_plain(const SlepianBasis& basis, const SlepianBasis::Weights& columns,
                             const std::uint16_t* waves, float* line) {
    sum_columns(
        basis, columns, [&](std::size_t i) { return core::float_of(waves[i]); }, line);
}

void sum_rows_plain(const SlepianBasis& basis, const SlepianBasis::Weights& rows, float sign, const float* lines,
                    const float* mask, float* numbers) {
    const std::size_t functions = basis.functions(), line = functions * 2 * lanes;
    for (std::size_t l = 0; l < functions; ++l)
        for (std::size_t i = 0; i < line; ++i) {
            const float* weights = rows.first + l * rows.stride;
            const float sum = sum_of(rows, [&](std::size_t row) { return weights[row] * lines[row * line + i]; });
            if (mask[i % lanes] != 0) numbers[l * line + i] = sign * sum;
        }
}

void add_lanes_plain(const SlepianBasis& basis, const float* numbers, std::span<const LaneTarget> targets) {
    for (std::size_t lane = 0; lane < targets.size(); ++lane)
        for (std::size_t l = 0; l < basis.functions(); ++l)
            for (std::size_t x = 0; x < basis.nodes(); ++x) {
                const Complex sum = node_of_lane(basis, numbers, targets[lane].carrier, lane, l, x);
                float* to = targets[lane].line.first + 2 * l * targets[lane].line.row + x;
                to[0] += sum.real();
                to[targets[lane].line.row] += sum.imag();
            }
}

void add_looks_plain(const SlepianBasis& basis, const float* numbers, const float* carrier, const LineTarget& line) {
    for (std::size_t look = 0; look < lanes; ++look)
        for (std::size_t l = 0; l < basis.functions(); ++l)
            for (std::size_t x = 0; x < basis.nodes(); ++x) {
                const Complex sum = node_of_lane(basis, numbers, carrier, look, l, x);
                float* to = line.first + 2 * l * line.row + x * lanes + look;
                to[0] += sum.real();
                to[line.row] += sum.imag();
            }
}

}  // namespace hogel::camera::hogel_spectra
