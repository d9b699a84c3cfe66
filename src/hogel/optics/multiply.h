// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <span>

namespace hogel::optics {

/// Computes out[x] = a[x] · b[x] for every x of `out`. The plain and the SIMD version agree to rounding.
void multiply_plain(const std::complex<float>* a, const std::complex<float>* b, std::span<std::complex<float>> out);
extern decltype(multiply_plain)& multiply;

}  // namespace hogel::optics
