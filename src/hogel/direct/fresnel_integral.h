// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

namespace hogel::direct {

/// ∫₀^w e^{iπt²/2} dt = C(w) + iS(w), to rounding: a power series for small w, a continued fraction for the rest.
/// Sources: Abramowitz and Stegun 7.3; the fraction is that of erfc.
std::complex<double> fresnel_integral_plain(double w);

/// The integral to 3·10⁻⁷, many times faster: cubics between entries of a table, whose slopes are known, and from
/// w = 8 on the asymptotic series.
std::complex<double> fresnel_integral(double w);

}  // namespace hogel::direct
