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

/// Rows of a hogel's square that are stored side by side: for each column the real parts of sixteen rows, then the
/// imaginary parts.
inline constexpr std::size_t rows_at_once = 16;
inline constexpr std::size_t square_column = 2 * rows_at_once;

/// out[x] = moduli[x] · e^{2πi b/256} with the bytes b that spread_random_phases gives to a square of `columns`
/// columns, a multiple of sixteen, in its rows first_row, first_row + 1, …. Plain and fast twins agree to rounding.
/// @param moduli  [columns][row]
/// @param out     [columns][part][row]
void random_waves_plain(const PhaseSeries& series, std::size_t first_row, const float* moduli, std::size_t columns,
                        float* out);
extern decltype(random_waves_plain)& random_waves;

/// The series of random phases of sixteen hogels or looks side by side.
struct SeriesOfLanes {
    std::array<std::uint32_t, 2> key;
    alignas(64) std::uint64_t position[3][rows_at_once];  ///< [word][lane]
};

/// The series of one of them.
PhaseSeries series_of_lane(const SeriesOfLanes& series, std::size_t lane);

/// Whether phases from the middle of a hogel with so many samples a side are bytes, too: (m + m′)(n − 1)/2n is a whole
/// number of 256ths of a cycle.
constexpr bool middle_is_a_byte(std::size_t columns) { return columns % 16 == 0 && 128 % columns == 0; }

/// One row of the waves of sixteen hogels or looks of such a side, with the phases of random_waves() but counted from
/// the middle of the hogel, for which (row + x)(n − 1)/2n cycles are added. Plain and fast twins agree to rounding.
/// @param shared  whether all lanes have the same moduli
/// @param moduli  [column], rows_at_once apart, if shared; otherwise [column][lane]
/// @param out     [column][part][lane]
void random_row_plain(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                      std::size_t columns, float* out);
extern decltype(random_row_plain)& random_row;

/// The phases from the middle of a hogel of any side: e^{iπk(n − 1)/n} for k = row + x, the parts one after the other.
std::vector<float> middle_phases(std::size_t columns);

/// As random_row(), of hogels of any side.
/// @param apart   from one column's moduli to the next; those of lanes follow each other unless `shared`
/// @param middle  middle_phases(columns)
void random_row_of_any_side_plain(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                                  std::size_t apart, std::span<const float> middle, std::size_t columns, float* out);
extern decltype(random_row_of_any_side_plain)& random_row_of_any_side;

/// out = moduli · phases. `phases` has the layout of `out`.
void shared_waves(std::span<const float> phases, const float* moduli, float* out);

/// Transposes sixteen rows [columns][part][row]: columns x, x + 1, … x + 15, x a multiple of sixteen, become rows
/// [row][part][column] that begin at to + x/16 · to_sixteen.
extern void (&transpose_rows)(const float* from, std::size_t columns, float* to, std::size_t to_sixteen);

/// to[row · to_row + i] = from[i][at + row] for sixteen rows; zero for i beyond the arrays that are given.
extern void (&gather_rows)(std::span<const float* const> from, std::size_t at, float* to, std::size_t to_row);

/// Transposes the same rows of sixteen hogels, [row][columns][hogel]: hogel h becomes [columns][row] at to +
/// h·to_hogel, for h < hogels.
extern void (&transpose_hogels)(const float* from, std::size_t columns, std::size_t hogels, float* to,
                                std::size_t to_hogel);

}  // namespace hogel::stereogram
