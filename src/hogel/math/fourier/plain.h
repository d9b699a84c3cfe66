// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace hogel::math::fourier {

/// The textbook transform of any length, Σ_j x_j e^{-2πi jk/n}: mixed radix while there are prime factors up to 13, and
/// Bluestein's convolution for what is left. The fast transforms are tested against it, and machines without vectors
/// use it.
void transform_plain(std::span<std::complex<float>> values);
/// The same in double precision, for tables.
void transform_plain_double(std::span<std::complex<double>> values);

}  // namespace hogel::math::fourier
