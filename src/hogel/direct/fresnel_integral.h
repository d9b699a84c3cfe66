// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

namespace hogel::direct {

/// ∫₀^w e^{iπt²/2} dt = C(w) + iS(w), exact to rounding, by a power series for small w and the continued fraction of
/// erfc for large w. Source: Abramowitz and Stegun 7.3.
std::complex<double> fresnel_integral_plain(double w);

/// The fast twin, accurate to 3·10⁻⁷: cubic Hermite interpolation in a table, and the asymptotic series from w = 8 on.
std::complex<double> fresnel_integral(double w);

}  // namespace hogel::direct
