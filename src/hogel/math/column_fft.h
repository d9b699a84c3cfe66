// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hogel::math {

/// Fourier transforms of columns whose length is a power of two. Neighbouring columns are lanes of a vector, so that
/// lanes are shuffled only to separate interleaved real and imaginary parts. Decimation in frequency with radix 4, with
/// a last step of radix 2 if the length is not a power of four, on a copy of sixteen columns that fits into the
/// first-level cache. Not normalised, like Fft2.
class ColumnFft {
  public:
    static constexpr std::size_t shortest = 8;
    /// The number of columns that are transformed together. In the split layout this number of real parts is followed
    /// by as many imaginary parts.
    static constexpr std::size_t together = 16;

    /// Whether the SIMD target in use has vectors, the length is a power of two from `shortest` on, and the columns are
    /// a multiple of `together`.
    static bool can(std::size_t length, std::size_t columns);

    explicit ColumnFft(std::size_t length);

    /// Sums with e^{+2πi jm/n}, or e^{-2πi jm/n} if forward. Row r of the columns is at from + r·from_row and its
    /// result at to + r·to_row, in complex numbers; `from` and `to` may be the same.
    void transform(bool forward, const std::complex<float>* from, std::size_t from_row, std::complex<float>* to,
                   std::size_t to_row, std::size_t columns) const;

    /// Sums with e^{+2πi jm/n} down sixteen columns in split layout, [row][part][column], in place; `columns` is
    /// aligned to a cache line.
    void backward_split(float* columns) const;

    /// As above, down many columns [column/16][row][part][column mod 16], with results interleaved as those of
    /// transform(). If rows of the result are aligned to cache lines and part of a larger array, they are written with
    /// non-temporal stores.
    void backward_split(const float* from, std::complex<float>* to, std::size_t to_row, std::size_t columns) const;

    struct Factor {
        float re, im;
    };
    struct Plan {
        std::size_t length;
        std::vector<std::uint32_t> order;  // [row]: its frequency after the last step
        std::vector<Factor>
            factors[2];  // w^j, w^2j, w^3j for each j of each radix-4 step but the last; backward, forward
    };

  private:
    Plan plan_;
};

}  // namespace hogel::math
