// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

namespace hogel::direct {

/// Returns ∫₀^w e^{iπt²/2} dt = C(w) + iS(w), exact to rounding: by a power series for small w and by the continued
/// fraction of erfc for large w. Source: Abramowitz and Stegun 7.3.
std::complex<double> fresnel_integral_plain(double w);

/// Fast version, error below 3·10⁻⁷: cubic Hermite interpolation in a table for w < 8, asymptotic series above.
std::complex<double> fresnel_integral(double w);

}  // namespace hogel::direct
