// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace hogel::math::fourier {

/// Reference transform of any length, Σ_j x_j e^{-2πi jk/n}: mixed radix for prime factors up to 13, Bluestein's
/// convolution for the rest. Used in tests of the fast transforms, and on targets without vectors.
void transform_plain(std::span<std::complex<float>> values);
/// Double-precision version, for tables.
void transform_plain_double(std::span<std::complex<double>> values);

}  // namespace hogel::math::fourier
