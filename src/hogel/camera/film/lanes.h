// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hogel/math/packed_complex.h"
#include "hogel/math/split_fft.h"

namespace hogel::camera::film {

/// Inner loops between the transforms of sixteen interleaved lines, with rows of sixteen complex numbers [part][lane]
/// as in math::SplitFft. Plain and fast twins agree to rounding. All arrays are aligned to cache lines.

/// Computes to[i] = wave[i] · lens[i] for rows of sixteen, and stores imaginary parts before real parts: SplitFft then
/// transforms with e^{+2πi jm/n}.
void times_lens_plain(const math::PackedComplex* wave, const float* lens, std::size_t rows, float* to);
extern decltype(times_lens_plain)& times_lens;

/// Packs selected rows of sixteen: row i of `to` is row indices[i] of `rows`.
void pack_rows_plain(const float* rows, std::span<const std::uint32_t> indices, math::PackedComplex* to);
extern decltype(pack_rows_plain)& pack_rows;

/// Transposes selected rows: value `lane` of row indices[i] becomes value i mod 16 of row `lane` of block i/16, for
/// lanes below `lanes`. The last block is padded with zeros.
/// @param to     the first row of the first block
/// @param block  floats from one block to the next
void transpose_selected_plain(const float* rows, std::span<const std::uint32_t> indices, std::size_t lanes, float* to,
                              std::size_t block);
extern decltype(transpose_selected_plain)& transpose_selected;

/// Computes out[i][lane] += down[i] across[lane] |row indices[i]|².
void add_intensities_plain(const float* rows, std::span<const std::uint32_t> indices, const float* across,
                           std::span<const float> down, float* out);
extern decltype(add_intensities_plain)& add_intensities;

/// Unpacks sixteen rows of a PackedBand from `count` adjacent squares to [column][part][row].
void interleave_rows_plain(const math::PackedComplex* squares, std::size_t count, float* to);
extern decltype(interleave_rows_plain)& interleave_rows;

/// Transposes a square of 16 × 16 floats: to[i][row] = rows[row][i]. Rows are `from_row` floats apart in `rows` and
/// `to_row` floats apart in `to`.
void transpose_block_plain(const float* rows, std::size_t from_row, std::size_t to_row, float* to);
extern decltype(transpose_block_plain)& transpose_block;

}  // namespace hogel::camera::film
