// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hogel::math {

/// Fourier transforms of columns with a power-of-two length. Adjacent columns are lanes of a vector; shuffles only
/// separate interleaved real and imaginary parts. Decimation in frequency with radix 4, and a last step of radix 2 if
/// needed, on a copy of sixteen columns that fits into the first-level cache. Not normalised, like Fft2.
class ColumnFft {
  public:
    static constexpr std::size_t shortest = 8;
    /// Number of columns in a batch. In the split layout the real parts of a batch precede its imaginary parts.
    static constexpr std::size_t batch_columns = 16;

    /// Returns whether the SIMD target in use has vectors, the length is a power of two and at least `shortest`, and
    /// the number of columns is a multiple of batch_columns.
    static bool can(std::size_t length, std::size_t columns);

    explicit ColumnFft(std::size_t length);

    /// Transforms columns: X[m] = Σ_j x[j] e^{+2πi jm/n}, or with e^{-2πi jm/n} if forward; j and m are rows, n is the
    /// length. Reads row r at from + r·from_row and writes it at to + r·to_row, in complex numbers. `from` and `to` may
    /// be equal.
    void transform(bool forward, const std::complex<float>* from, std::size_t from_row, std::complex<float>* to,
                   std::size_t to_row, std::size_t columns) const;

    /// Transforms sixteen columns backwards (with e^{+2πi jm/n}) in place, in split layout [row][part][column], aligned
    /// to a cache line.
    void backward_split(float* columns) const;

    /// Transforms columns backwards from [column/16][row][part][column mod 16] to interleaved complex numbers, with row
    /// r at to + r·to_row. If the rows of the result are aligned to cache lines and part of a larger array, writes with
    /// non-temporal stores.
    void backward_split(const float* from, std::complex<float>* to, std::size_t to_row, std::size_t columns) const;

    struct Factor {
        float re, im;
    };
    struct Plan {
        std::size_t length;
        std::vector<std::uint32_t> order;  // [row]: frequency after the last step
        std::vector<Factor> factors[2];    // [backward, forward]: w^j, w^2j, w^3j per j and radix-4 step but the last
    };

  private:
    Plan plan_;
};

}  // namespace hogel::math
