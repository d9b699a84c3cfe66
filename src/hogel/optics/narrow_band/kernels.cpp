// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/narrow_band/kernels.h"

namespace hogel::optics::narrow_band {

void weighted_rows_plain(const std::complex<float>* rows, std::size_t stride,
                         std::span<const std::complex<float>> weights, std::span<std::complex<float>> out) {
    for (std::size_t x = 0; x < out.size(); ++x) {
        std::complex<float> sum = 0;
        for (std::size_t r = 0; r < weights.size(); ++r) sum += weights[r] * rows[r * stride + x];
        out[x] = sum;
    }
}

void decimated_line_plain(const std::complex<float>* line, std::size_t step, std::span<const float> taps,
                          std::span<std::complex<float>> out) {
    for (std::size_t n = 0; n < out.size(); ++n) {
        std::complex<float> sum = 0;
        for (std::size_t k = 0; k < taps.size() / 2; ++k) sum += taps[2 * k] * line[n * step + k];
        out[n] = sum;
    }
}

void multiply_plain(const std::complex<float>* a, const std::complex<float>* b, std::span<std::complex<float>> out) {
    // Written out, because the product of std::complex checks for infinities.
    for (std::size_t x = 0; x < out.size(); ++x)
        out[x] = {a[x].real() * b[x].real() - a[x].imag() * b[x].imag(),
                  a[x].real() * b[x].imag() + a[x].imag() * b[x].real()};
}

}  // namespace hogel::optics::narrow_band
