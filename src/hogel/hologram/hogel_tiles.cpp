// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/hogel_tiles.h"

#include <array>

namespace hogel::hologram {

void random_waves_plain(const PhaseSeries& series, std::size_t first_row, const float* moduli, std::size_t columns,
                        float* out) {
    std::array<float, 16> some;
    std::array<std::complex<float>, 16> waves;
    for (std::size_t row = 0; row < rows_at_once; ++row)
        for (std::size_t x0 = 0; x0 < columns; x0 += 16) {
            for (std::size_t x = 0; x < 16; ++x) some[x] = moduli[(x0 + x) * rows_at_once + row];
            spread_random_phases(series, some, waves,
                                 static_cast<std::uint32_t>(((first_row + row) * columns + x0) / 16));
            for (std::size_t x = 0; x < 16; ++x) {
                out[(x0 + x) * square_column + row] = waves[x].real();
                out[(x0 + x) * square_column + rows_at_once + row] = waves[x].imag();
            }
        }
}

void shared_waves(std::span<const float> phases, const float* moduli, float* out) {
    for (std::size_t i = 0; i < phases.size(); i += square_column, moduli += rows_at_once)
        for (std::size_t row = 0; row < rows_at_once; ++row) {
            out[i + row] = moduli[row] * phases[i + row];
            out[i + rows_at_once + row] = moduli[row] * phases[i + rows_at_once + row];
        }
}

}  // namespace hogel::hologram
