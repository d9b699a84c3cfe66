// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hogel/camera/hogel_spectra/slepian_basis.h"
#include "hogel/camera/hogel_spectra/spread_line.h"

namespace hogel::camera::hogel_spectra {

/// The projection of project() for sixteen hogels or looks in the lanes of vectors. It transposes only its result and
/// fills all lanes. The result of a lane does not depend on the others. Plain and fast twins agree to rounding.

/// Sums waves over the pairs in `columns`: line[function][part][lane] = Σ_column D_k waves[column][part][lane].
void sum_row_plain(const SlepianBasis& basis, const SlepianBasis::Weights& columns, const float* waves, float* line);
extern decltype(sum_row_plain)& sum_row;
/// A row in binary16 to prefetch, beginning with the first in-band column.
struct NextRow {
    const std::uint16_t* waves = nullptr;
    std::size_t first_column = 0;
};
/// Does the same for waves in binary16, and prefetches the next row.
void sum_row_of_halves_plain(const SlepianBasis& basis, const SlepianBasis::Weights& columns,
                             const std::uint16_t* waves, float* line);
extern void (&sum_row_of_halves)(const SlepianBasis& basis, const SlepianBasis::Weights& columns,
                                 const std::uint16_t* waves, const NextRow& next, float* line);

/// Sums rows over the pairs in `rows`, which may omit rows of zeros: numbers[down][across][part][lane] = sign · Σ_row
/// D_l lines[row][function][part][lane].
/// @param mask  [lane]: 1 to store the result, 0 to leave the lane unchanged
void sum_rows_plain(const SlepianBasis& basis, const SlepianBasis::Weights& rows, float sign, const float* lines,
                    const float* mask, float* numbers);
extern decltype(sum_rows_plain)& sum_rows;

/// Destination of a lane in its line, and the carrier across, see SlepianBasis::Weights.
struct LaneTarget {
    const float* carrier;
    LineTarget line;
};

/// Adds the light of lanes to their lines: numbers E_xᵀ times the carrier, with E = spread() of the basis and a factor
/// i for each odd function across or down. It reads and writes padded(nodes) numbers of each row of a line.
void add_lanes_plain(const SlepianBasis& basis, const float* numbers, std::span<const LaneTarget> targets);
extern decltype(add_lanes_plain)& add_lanes;

/// Does the same for sixteen looks of one hogel, with interleaved looks in the line: [function down][part][node
/// across][look]. This needs no transpose.
/// @param line  aligned to a cache line; only numbers of nodes are read and written
void add_looks_plain(const SlepianBasis& basis, const float* numbers, const float* carrier, const LineTarget& line);
extern decltype(add_looks_plain)& add_looks;

}  // namespace hogel::camera::hogel_spectra
