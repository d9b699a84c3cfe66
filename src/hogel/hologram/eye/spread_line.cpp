// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/eye/spread_line.h"

namespace hogel::hologram::eye {

using Complex = std::complex<float>;

namespace {

void add_to(Complex& sum, Complex value) { sum += value; }
void add_to(math::PackedComplex& sum, Complex value) { sum = math::pack(math::unpacked(sum) + value); }

template <class Number>
void add_row(const LightRow& row, std::size_t columns, Number* band, std::size_t block) {
    for (std::size_t x = 0; x < columns; ++x)
        add_to(band[x / lanes * block + x % lanes], Complex(row.light[x], row.light[row.light_row + x]) *
                                                        Complex(row.phases[x], row.phases[row.phase_row + x]));
}

template <class Number>
void add_rows(const LightRow& row, std::size_t columns, std::span<Number* const> bands, std::size_t block) {
    for (std::size_t look = 0; look < bands.size(); ++look)
        for (std::size_t x = 0; x < columns; ++x) {
            const float* light = row.light + x * lanes + look;
            add_to(bands[look][x / lanes * block + x % lanes],
                   Complex(light[0], light[row.light_row]) * Complex(row.phases[x], row.phases[row.phase_row + x]));
        }
}

}  // namespace

void spread_line_plain(const HogelBasis& down, const float* carrier, const float* line, std::size_t row,
                       std::size_t columns, float* light) {
    const std::size_t nodes = down.nodes();
    for (std::size_t y = 0; y < nodes; ++y)
        for (std::size_t x = 0; x < columns; ++x) {
            Complex sum = 0;
            for (std::size_t l = 0; l < down.functions(); ++l)
                sum += down.spread()(y, l) * Complex(line[2 * l * row + x], line[(2 * l + 1) * row + x]);
            sum *= Complex(carrier[y], carrier[padded(nodes) + y]);
            light[2 * y * row + x] += sum.real();
            light[(2 * y + 1) * row + x] += sum.imag();
        }
}

void add_demodulated_plain(const LightRow& row, std::size_t columns, Complex* band, std::size_t block) {
    add_row(row, columns, band, block);
}
void add_demodulated_plain(const LightRow& row, std::size_t columns, math::PackedComplex* band, std::size_t block) {
    add_row(row, columns, band, block);
}

void add_demodulated_looks_plain(const LightRow& row, std::size_t columns, std::span<Complex* const> bands,
                                 std::size_t block) {
    add_rows(row, columns, bands, block);
}
void add_demodulated_looks_plain(const LightRow& row, std::size_t columns, std::span<math::PackedComplex* const> bands,
                                 std::size_t block) {
    add_rows(row, columns, bands, block);
}

}  // namespace hogel::hologram::eye
