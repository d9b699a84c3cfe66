// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hogel/camera/hogel_spectra/slepian_basis.h"
#include "hogel/camera/hogel_spectra/spread_line.h"

namespace hogel::camera::hogel_spectra {

/// The projection of project() for sixteen hogels or looks side by side, the lanes of vectors: nothing is transposed
/// before the end, and no lane is empty. Lanes do not mix, so that the light of each is the same in any company.
/// Plain and fast twins agree to rounding.

/// Sums a row of waves over the columns of the pairs in `columns`, from which some may be missing:
/// line[function][part][lane] = Σ_column D_k waves[column][part][lane].
void sum_row_plain(const SlepianBasis& basis, const SlepianBasis::Weights& columns, const float* waves, float* line);
extern decltype(sum_row_plain)& sum_row;
/// A row in binary16 that will be summed soon, from the first column that counts on: it is fetched meanwhile.
struct NextRow {
    const std::uint16_t* waves = nullptr;
    std::size_t first_column = 0;
};
/// The same for waves in binary16.
void sum_row_of_halves_plain(const SlepianBasis& basis, const SlepianBasis::Weights& columns,
                             const std::uint16_t* waves, float* line);
extern void (&sum_row_of_halves)(const SlepianBasis& basis, const SlepianBasis::Weights& columns,
                                 const std::uint16_t* waves, const NextRow& next, float* line);

/// Sums all rows of the pairs in `rows`, from which dark ones may be missing: numbers[down][across][part][lane] =
/// sign · Σ_row D_l lines[row][function][part][lane].
/// @param chosen  for each lane, whether it is stored (1) or left as it is (0)
void sum_rows_plain(const SlepianBasis& basis, const SlepianBasis::Weights& rows, float sign, const float* lines,
                    const float* chosen, float* numbers);
extern decltype(sum_rows_plain)& sum_rows;

/// The place of a lane in its line, and the carrier across as in SlepianBasis::Weights.
struct LaneTarget {
    const float* carrier;
    LineTarget line;
};

/// Adds the light of lanes to their lines: numbers E_xᵀ, times the carrier, with E = spread() of the basis, and a
/// factor i for each odd function across or down. padded(nodes) numbers of each row of a line are read and written.
void add_lanes_plain(const SlepianBasis& basis, const float* numbers, std::span<const LaneTarget> targets);
extern decltype(add_lanes_plain)& add_lanes;

/// The same where lanes are looks of one hogel, for lines that have sixteen looks side by side: [function
/// down][part][node across][look]. Nothing has to be turned.
/// @param line  aligned to a cache line; only numbers of nodes are read and written
void add_looks_plain(const SlepianBasis& basis, const float* numbers, const float* carrier, const LineTarget& line);
extern decltype(add_looks_plain)& add_looks;

}  // namespace hogel::camera::hogel_spectra
