// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>

#include "hogel/array.h"

namespace hogel::optics::narrow_band {

/// The inner loops of the narrow-band camera. Plain and fast twins agree to rounding.

/// out[x] = Σ_r weights[r] · rows[r·stride + x], for every x of `out`: the low-pass down the columns of a tile.
void weighted_rows_plain(const std::complex<float>* rows, std::size_t stride,
                         std::span<const std::complex<float>> weights, std::span<std::complex<float>> out);
void weighted_rows(const std::complex<float>* rows, std::size_t stride, std::span<const std::complex<float>> weights,
                   std::span<std::complex<float>> out);

/// out[n] = Σ_k taps[2k] · line[n·step + k]: the low-pass along a line that keeps every step-th value. Each tap is
/// stored twice, for the real and the imaginary part.
void decimated_line_plain(const std::complex<float>* line, std::size_t step, std::span<const float> taps,
                          std::span<std::complex<float>> out);
void decimated_line(const std::complex<float>* line, std::size_t step, std::span<const float> taps,
                    std::span<std::complex<float>> out);

/// out[x] = a[x] · b[x], for every x of `out`.
void multiply_plain(const std::complex<float>* a, const std::complex<float>* b, std::span<std::complex<float>> out);
void multiply(const std::complex<float>* a, const std::complex<float>* b, std::span<std::complex<float>> out);

}  // namespace hogel::optics::narrow_band
