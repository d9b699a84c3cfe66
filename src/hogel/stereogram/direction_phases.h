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

/// Phases shared by all hogels, [look][row][column]: e^{iφ} for each frequency of a hogel's Fourier transform.
using DirectionPhases = std::vector<Array<std::complex<float>, 2>>;
/// Computes the shared phases of all looks.
/// @param flat  true: phases designed for a flat fringe (flatten_fringe()); false: random phases
DirectionPhases direction_phases(const FrequencyGrid& frequencies, const math::Fft2& fft,
                                 const HologramOptions& options, bool flat);

/// Writes the lines of a hogel with horizontal parallax only and shared phases: line i is `line` times a random
/// e^{iφ_i}. Equal lines would send light only straight ahead.
/// @param to  first line; line i begins at to + i·to_stride; `line` may be the first
void write_lines(const HologramOptions& options, const HogelKey& hogel, std::size_t lines,
                 std::span<const std::complex<float>> line, std::complex<float>* to, std::size_t to_stride);

}  // namespace hogel::stereogram
