// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/hogel_tiles.h"

#include <array>
#include <cmath>
#include <numbers>

#include "hogel/stereogram/random_bytes.h"

namespace hogel::stereogram {

void random_waves_plain(const PhaseSeries& series, std::size_t first_row, const float* moduli, std::size_t columns,
                        float* out) {
    std::array<float, 16> row_moduli;
    std::array<std::complex<float>, 16> waves;
    for (std::size_t row = 0; row < rows_at_once; ++row)
        for (std::size_t x0 = 0; x0 < columns; x0 += 16) {
            for (std::size_t x = 0; x < 16; ++x) row_moduli[x] = moduli[(x0 + x) * rows_at_once + row];
            spread_random_phases(series, row_moduli, waves,
                                 static_cast<std::uint32_t>(((first_row + row) * columns + x0) / 16));
            for (std::size_t x = 0; x < 16; ++x) {
                out[(x0 + x) * square_column + row] = waves[x].real();
                out[(x0 + x) * square_column + rows_at_once + row] = waves[x].imag();
            }
        }
}

PhaseSeries series_of_lane(const SeriesOfLanes& series, std::size_t lane) {
    PhaseSeries result{series.key, {}};
    for (std::size_t word = 0; word < 3; ++word)
        result.position[word] = static_cast<std::uint32_t>(series.position[word][lane]);
    return result;
}

void random_row_plain(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                      std::size_t columns, float* out) {
    const PhaseRoots& roots = phase_roots();
    const std::size_t step = 128 - 128 / columns;
    std::array<std::uint8_t, 16> bytes;
    for (std::size_t lane = 0; lane < rows_at_once; ++lane) {
        const PhaseSeries lane_series = series_of_lane(series, lane);
        for (std::size_t x = 0; x < columns; ++x) {
            if (x % 16 == 0)
                random_bytes_plain(lane_series, static_cast<std::uint32_t>((row * columns + x) / 16), bytes);
            const std::size_t byte = (bytes[x % 16] + (row + x) * step) % 256;
            const float modulus = moduli[x * rows_at_once + (shared ? 0 : lane)];
            out[x * square_column + lane] = modulus * roots.re[byte];
            out[x * square_column + rows_at_once + lane] = modulus * roots.im[byte];
        }
    }
}

std::vector<float> middle_phases(std::size_t columns) {
    std::vector<float> phases;
    const auto n = static_cast<double>(columns);
    for (std::size_t k = 0; k < 2 * columns; ++k) {
        const double angle = std::numbers::pi * std::fmod(static_cast<double>(k) * (n - 1) / n, 2.0);
        phases.push_back(static_cast<float>(std::cos(angle)));
        phases.push_back(static_cast<float>(std::sin(angle)));
    }
    return phases;
}

void random_row_of_any_side_plain(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                                  std::size_t column_stride, std::span<const float> middle, std::size_t columns,
                                  float* out) {
    const PhaseRoots& roots = phase_roots();
    std::array<std::uint8_t, 16> bytes;
    for (std::size_t lane = 0; lane < rows_at_once; ++lane) {
        const PhaseSeries lane_series = series_of_lane(series, lane);
        for (std::size_t x = 0; x < columns; ++x) {
            const std::size_t index = row * columns + x;
            if (x == 0 || index % 16 == 0)
                random_bytes_plain(lane_series, static_cast<std::uint32_t>(index / 16), bytes);
            const float modulus = moduli[x * column_stride + (shared ? 0 : lane)];
            const std::complex<float> wave = modulus *
                                             std::complex(roots.re[bytes[index % 16]], roots.im[bytes[index % 16]]) *
                                             std::complex(middle[2 * (row + x)], middle[2 * (row + x) + 1]);
            out[x * square_column + lane] = wave.real();
            out[x * square_column + rows_at_once + lane] = wave.imag();
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

}  // namespace hogel::stereogram
