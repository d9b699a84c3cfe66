// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

#include "hogel/array.h"
#include "hogel/math/fft.h"

namespace hogel::hologram {

/// Changes the phases of a spectrum of given moduli until the modulus of its fringe is nearly constant, so that a
/// modulator's range is not spent on rare peaks: alternating projections between the moduli and a flat fringe, from the
/// phases given. Source: Lucente, "Diffraction-specific fringe computation for electro-holography", MIT 1994; Gerchberg
/// and Saxton 1972.
/// @param moduli  of the DFT coefficients, shape of the transform
/// @param phases  unit numbers, in and out
void flatten_fringe(View<const float, 2> moduli, const math::Fft2& fft, View<std::complex<float>, 2> phases);

}  // namespace hogel::hologram
