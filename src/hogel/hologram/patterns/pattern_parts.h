// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/pattern.h"

namespace hogel::hologram::patterns {

/// The carrier wave e^{2πi f_x·column}, by column. The useful order of a pattern is F times the carrier.
using Carrier = std::vector<std::complex<float>>;

/// The half bandwidth of a field along x, cycles per sample, which contains 95 % of its light; the edges of hogels
/// scatter the rest widely.
double band_along_x(View<const std::complex<float>, 2> field);

/// Encodes a field with |F| <= 1 as amplitudes in [0, 1], for the encodings for amplitude. Sets `carrier` and `angle`
/// to those of the order that carries F. Throws Error(usage) if the orders would overlap.
Array<float, 2> encode_amplitude(View<const std::complex<float>, 2> field, const PatternOptions& options,
                                 double wavelength, Carrier& carrier, double& angle);

/// Encoding::gerchberg_saxton: phases in cycles [0, 1), by alternating projections in squares.
Array<float, 2> iterate_phases(View<const std::complex<float>, 2> field, const PatternOptions& options,
                               const Progress& progress);

/// Encoding::gradient: phases in cycles [0, 1), by stochastic gradient descent.
Array<float, 2> descend_phases(View<const std::complex<float>, 2> field, const PatternOptions& options,
                               const Progress& progress);

/// Throws Error(usage) unless squares of this side fit the modulator.
void require_squares_fit(View<const std::complex<float>, 2> field, std::size_t side);

}  // namespace hogel::hologram::patterns
