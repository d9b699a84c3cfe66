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

/// Returns the series of random phases of hogel (s, t) for one look.
PhaseSeries phase_series(const HologramOptions& options, std::size_t s, std::size_t t, std::size_t look);

/// Phases shared by all hogels: for each look, e^{iφ} for each frequency of a hogel's Fourier transform.
/// @param flat  designed for a flat fringe; otherwise random
using DirectionPhases = std::vector<Array<std::complex<float>, 2>>;
DirectionPhases direction_phases(const FrequencyGrid& frequencies, const math::Fft2& fft,
                                 const HologramOptions& options, bool flat);

/// Writes the lines of a hogel with horizontal parallax only and shared phases: line i is `line` times a random
/// e^{iφ_i}. Equal lines would send light only straight ahead.
/// @param to  first line; line i begins at to + i·to_stride; `line` may be the first
void write_lines(const HologramOptions& options, const HogelKey& hogel, std::size_t lines,
                 std::span<const std::complex<float>> line, std::complex<float>* to, std::size_t to_stride);

}  // namespace hogel::stereogram
