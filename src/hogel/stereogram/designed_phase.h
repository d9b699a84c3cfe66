// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

#include "hogel/array.h"
#include "hogel/math/fft.h"

namespace hogel::stereogram {

/// Computes phases for a spectrum of given moduli that make the modulus of its fringe nearly constant, which avoids
/// rare peaks that cost modulator range. Alternates projections between the moduli and a flat fringe, from the given
/// phases. Source: Lucente, "Diffraction-specific fringe computation for electro-holography", MIT 1994; Gerchberg and
/// Saxton 1972.
/// @param moduli  of the DFT coefficients, in the shape of the transform
/// @param phases  complex numbers of modulus 1, in and out
void flatten_fringe(View<const float, 2> moduli, const math::Fft2& fft, View<std::complex<float>, 2> phases);

}  // namespace hogel::stereogram
