// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hogel/math/packed_complex.h"
#include "hogel/math/split_fft.h"

namespace hogel::camera::film {

/// The inner loops between the transforms of sixteen lines side by side, whose rows are sixteen complex numbers
/// [part][lane] as in math::SplitFft. Plain and fast twins agree to rounding. All arrays are aligned to cache lines.

/// to[i] = wave[i] · lens[i] for rows of sixteen, with the parts of the result exchanged.
void times_lens_plain(const math::PackedComplex* wave, const float* lens, std::size_t rows, float* to);
extern decltype(times_lens_plain)& times_lens;

/// Packs rows of sixteen: row i of `to` is row places[i].
void pack_rows_plain(const float* rows, std::span<const std::uint32_t> places, math::PackedComplex* to);
extern decltype(pack_rows_plain)& pack_rows;

/// Turns rows into lines: value `lane` of row places[i] becomes value i mod 16 of row `lane` of block i/16, for lanes
/// below `lanes`; values of the last block beyond the places are zero.
/// @param to     the first row of the first block
/// @param block  floats from one block to the next
void transpose_selected_plain(const float* rows, std::span<const std::uint32_t> places, std::size_t lanes, float* to,
                              std::size_t block);
extern decltype(transpose_selected_plain)& transpose_selected;

/// out[i][lane] += down[i] across[lane] |row places[i]|²
void add_intensities_plain(const float* rows, std::span<const std::uint32_t> places, const float* across,
                           std::span<const float> down, float* out);
extern decltype(add_intensities_plain)& add_intensities;

/// Sixteen rows of packed numbers, in squares (PackedBand), side by side.
void side_by_side_plain(const math::PackedComplex* squares, std::size_t count, float* to);
extern decltype(side_by_side_plain)& side_by_side;

/// The transpose of sixteen rows: to[i][row] = rows[row][i], with so many floats from row to row.
void transpose_block_plain(const float* rows, std::size_t from_row, std::size_t to_row, float* to);
extern decltype(transpose_block_plain)& transpose_block;

}  // namespace hogel::camera::film
