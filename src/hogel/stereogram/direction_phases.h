// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <vector>

#include "hogel/hologram.h"
#include "hogel/math/fft.h"
#include "hogel/stereogram/frequency_grid.h"
#include "hogel/stereogram/hogel_synthesis.h"
#include "hogel/stereogram/random_phase.h"

namespace hogel::stereogram {

/// The series of random phases of a hogel.
PhaseSeries phase_series(const HologramOptions& options, std::size_t s, std::size_t t, std::size_t look);

/// Phases that all hogels share: for each look, e^{iφ} for each frequency of a hogel's Fourier transform.
/// @param flat  designed for a flat fringe; otherwise random
using DirectionPhases = std::vector<Array<std::complex<float>, 2>>;
DirectionPhases direction_phases(const FrequencyGrid& frequencies, const math::Fft2& fft,
                                 const HologramOptions& options, bool flat);

/// Writes the lines of a hologram with horizontal parallax only whose hogels share phases: line number i of the hogel
/// is `line` times e^{iφ} with a phase of that line's own, because equal lines would send light only straight ahead.
/// @param to  the first line; line number i begins at to + i·to_row; `line` may be the first
void write_lines(const HologramOptions& options, const HogelKey& hogel, std::size_t lines,
                 std::span<const std::complex<float>> line, std::complex<float>* to, std::size_t to_row);

}  // namespace hogel::stereogram
