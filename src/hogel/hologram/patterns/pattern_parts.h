// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/pattern.h"

namespace hogel::hologram::patterns {

/// The wave that a pattern's useful order is F times of: e^{2πi f_x·column}, by column.
using Carrier = std::vector<std::complex<float>>;

/// A field's reach in frequency along x, cycles a sample: 95 % of its light lies within; the edges
/// of hogels scatter the rest widely.
double band_along_x(View<const std::complex<float>, 2> field);

/// Amplitudes in [0, 1] of a field with |F| <= 1, for the encodings that are not phases. `carrier` and `angle` become
/// those of the order that carries F. Throws Error(usage) where the orders would overlap.
Array<float, 2> encode_amplitude(View<const std::complex<float>, 2> field, const PatternOptions& options,
                                 double wavelength, Carrier& carrier, double& angle);

/// Phases, in cycles [0, 1), by alternating projections in squares: Encoding::gerchberg_saxton.
Array<float, 2> iterate_phases(View<const std::complex<float>, 2> field, const PatternOptions& options,
                               const Progress& progress);

/// Phases, in cycles [0, 1), by stochastic gradient descent: Encoding::gradient.
Array<float, 2> descend_phases(View<const std::complex<float>, 2> field, const PatternOptions& options,
                               const Progress& progress);

/// Throws Error(usage) unless squares of this side fit the modulator.
void require_squares_fit(View<const std::complex<float>, 2> field, std::size_t side);

}  // namespace hogel::hologram::patterns
