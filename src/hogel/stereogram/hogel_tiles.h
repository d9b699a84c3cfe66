// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/stereogram/random_phase.h"

namespace hogel::stereogram {

/// Number of rows of a hogel's square that are processed side by side, and number of floats of each column of these
/// rows: sixteen real parts, then sixteen imaginary parts.
inline constexpr std::size_t rows_at_once = 16;
inline constexpr std::size_t square_column = 2 * rows_at_once;

/// Computes out[x] = moduli[x] · e^{2πi b/256} for the sixteen rows that begin at first_row, with the bytes b that
/// spread_random_phases() gives to a square of `columns` columns, a multiple of sixteen. Plain and fast versions agree
/// to rounding.
/// @param moduli  [columns][row]
/// @param out     [columns][part][row]
void random_waves_plain(const PhaseSeries& series, std::size_t first_row, const float* moduli, std::size_t columns,
                        float* out);
extern decltype(random_waves_plain)& random_waves;

/// Series of random phases of sixteen hogels or looks side by side.
struct SeriesOfLanes {
    std::array<std::uint32_t, 2> key;
    alignas(64) std::uint64_t position[3][rows_at_once];  ///< [word][lane]
};

PhaseSeries series_of_lane(const SeriesOfLanes& series, std::size_t lane);

/// Returns whether phases counted from the middle of a hogel of n columns are whole 256ths of a cycle for all waves (m,
/// m′): their difference from phases of the first sample is (m + m′)(n − 1)/2n cycles.
constexpr bool middle_is_a_byte(std::size_t columns) { return columns % 16 == 0 && 128 % columns == 0; }

/// Computes one row of the waves of sixteen hogels or looks with the phases of random_waves(), counted from the middle
/// of the hogel: plus (row + x)(n − 1)/2n cycles. Requires middle_is_a_byte(columns). Plain and fast versions agree to
/// rounding.
/// @param shared  whether all lanes have the same moduli
/// @param moduli  [column], rows_at_once apart, if shared; otherwise [column][lane]
/// @param out     [column][part][lane]
void random_row_plain(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                      std::size_t columns, float* out);
extern decltype(random_row_plain)& random_row;

/// Returns the factors that convert phases counted from the first sample to phases counted from the middle of a hogel,
/// for any side n = columns: e^{iπk(n − 1)/n} for k = row + x, [k][part].
std::vector<float> middle_phases(std::size_t columns);

/// As random_row(), for hogels of any side.
/// @param column_stride  distance of the moduli of adjacent columns; those of lanes are contiguous unless `shared`
/// @param middle         middle_phases(columns)
void random_row_of_any_side_plain(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                                  std::size_t column_stride, std::span<const float> middle, std::size_t columns,
                                  float* out);
extern decltype(random_row_of_any_side_plain)& random_row_of_any_side;

/// Computes out = moduli · phases. `phases` has the layout of `out`.
void shared_waves(std::span<const float> phases, const float* moduli, float* out);

/// Transposes sixteen rows of complex numbers from [column][part][row] to blocks of sixteen columns,
/// [block][row][part][column mod 16].
/// @param columns       a multiple of sixteen
/// @param block_stride  distance of the blocks in `to`, floats
extern void (&transpose_rows)(const float* from, std::size_t columns, float* to, std::size_t block_stride);

/// Gathers sixteen rows from up to sixteen arrays: to[row · to_stride + i] = from[i][offset + row]; zero for i beyond
/// the given arrays.
extern void (&gather_rows)(std::span<const float* const> from, std::size_t offset, float* to, std::size_t to_stride);

/// Transposes sixteen rows of up to sixteen hogels from [row][column][hogel] to [hogel][column][row].
/// @param hogels        number of hogels to store; `from` has sixteen
/// @param hogel_stride  distance of the hogels in `to`, floats
extern void (&transpose_hogels)(const float* from, std::size_t columns, std::size_t hogels, float* to,
                                std::size_t hogel_stride);

}  // namespace hogel::stereogram
