// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/spread_line.h"

namespace hogel::camera::hogel_spectra {

using Complex = std::complex<float>;

namespace {

void add_to(math::PackedComplex* band, std::size_t x, Complex light, const LightRow& row) {
    math::PackedComplex& sum = band[x / lanes * camera::PackedBand::square + x % lanes];
    sum = math::pack(math::unpacked(sum) + light * Complex(row.phases[x], row.phases[row.phase_row + x]));
}

}  // namespace

void spread_line_plain(const SlepianBasis& down, const float* carrier, const float* line, std::size_t row,
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

void add_demodulated_plain(const LightRow& row, std::size_t columns, math::PackedComplex* band) {
    for (std::size_t x = 0; x < columns; ++x) add_to(band, x, Complex(row.light[x], row.light[row.light_row + x]), row);
}

void add_demodulated_looks_plain(const LightRow& row, std::size_t columns,
                                 std::span<math::PackedComplex* const> bands) {
    for (std::size_t look = 0; look < bands.size(); ++look)
        for (std::size_t x = 0; x < columns; ++x) {
            const float* light = row.light + x * lanes + look;
            add_to(bands[look], x, Complex(light[0], light[row.light_row]), row);
        }
}

}  // namespace hogel::camera::hogel_spectra
