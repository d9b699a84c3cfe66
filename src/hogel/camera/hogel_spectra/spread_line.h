// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "hogel/camera/hogel_spectra/slepian_basis.h"
#include "hogel/camera/packed_band.h"

namespace hogel::camera::hogel_spectra {

// Hogels of a row with the same weights down share a line. Their numbers are added where nodes overlap across, before
// they are spread down. So a hogel takes as many columns as its share of the band, instead of all its nodes.

/// Address in a line, [function down][part][node across], and the floats from row to row.
struct LineTarget {
    float* first;
    std::size_t row;
};

/// Adds a line to rows of light: light[node down][part][column] += E_y line, times the carrier of these rows, with E =
/// spread() of the basis. The factor i of odd functions is part of the line. Plain and fast twins agree to rounding.
/// @param carrier  as in SlepianBasis::Weights
/// @param line     aligned to a cache line, as `light` is; rows of both are `row` floats apart
/// @param columns  a multiple of `lanes`
void spread_line_plain(const SlepianBasis& down, const float* carrier, const float* line, std::size_t row,
                       std::size_t columns, float* light);
extern decltype(spread_line_plain)& spread_line;

/// A row of a chunk's light, [part][column], or [part][column][look] for sixteen interleaved looks, and the phases of
/// its demodulation, [part][column]. All are aligned to a cache line. Parts are `light_row` and `phase_row` floats
/// apart; `phase_row` is a multiple of `lanes`.
struct LightRow {
    const float* light;
    std::size_t light_row;
    const float* phases;
    std::size_t phase_row;
};

/// Demodulates a row of light and adds it to a row of a band, at a square's beginning. Twins agree to rounding.
void add_demodulated_plain(const LightRow& row, std::size_t columns, math::PackedComplex* band);
extern decltype(add_demodulated_plain)& add_demodulated;
/// Does the same for a row of several interleaved looks.
void add_demodulated_looks_plain(const LightRow& row, std::size_t columns, std::span<math::PackedComplex* const> bands);
extern decltype(add_demodulated_looks_plain)& add_demodulated_looks;

}  // namespace hogel::camera::hogel_spectra
