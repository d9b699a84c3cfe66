// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "hogel/camera/hogel_spectra/slepian_basis.h"
#include "hogel/camera/packed_band.h"

namespace hogel::camera::hogel_spectra {

// Hogels of a row that an eye sees with the same weights down share a line: where their nodes meet across, their
// numbers are added before they are spread down, so that a hogel takes as many columns as its share of the band has
// samples, instead of all its nodes.

/// A place in a line, [function down][part][node across], whose rows are `row` floats apart.
struct LineTarget {
    float* first;
    std::size_t row;
};

/// Adds a line's light at the nodes down to rows of light: light[node down][part][column] += E_y line, times the
/// carrier of these rows, with E = spread() of the basis. A factor i for odd functions is part of the line.
/// Plain and fast twins agree to rounding.
/// @param carrier  as in SlepianBasis::Weights
/// @param line     aligned to a cache line, as `light`; rows of both are `row` floats apart
/// @param columns  a multiple of `lanes`
void spread_line_plain(const SlepianBasis& down, const float* carrier, const float* line, std::size_t row,
                       std::size_t columns, float* light);
extern decltype(spread_line_plain)& spread_line;

/// A row of a part's light, [part][column], or with sixteen looks side by side, [part][column][look], and the phases of
/// its demodulation, [part][column]. All are aligned to a cache line; parts of light are `light_row` floats apart,
/// those of phases `phase_row`, a multiple of `lanes`.
struct LightRow {
    const float* light;
    std::size_t light_row;
    const float* phases;
    std::size_t phase_row;
};

/// Adds a row of light, demodulated, to a row of a band, from where a square of it begins on (camera::PackedBand).
/// Plain and fast twins agree to rounding.
void add_demodulated_plain(const LightRow& row, std::size_t columns, math::PackedComplex* band);
extern decltype(add_demodulated_plain)& add_demodulated;
/// The same for a row of each of some looks that lie side by side.
void add_demodulated_looks_plain(const LightRow& row, std::size_t columns, std::span<math::PackedComplex* const> bands);
extern decltype(add_demodulated_looks_plain)& add_demodulated_looks;

}  // namespace hogel::camera::hogel_spectra
