// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hogel::math {

/// Transforms of columns whose length is a power of two, a vector of neighbouring columns at a time: nothing is ever
/// shuffled but the two parts of a number, where they do not lie apart already. Decimation in frequency by fours, with
/// a last step by two where the length is no power of four, on a copy of some columns that fits into the nearest cache.
/// Not normalised, like Fft2.
class ColumnFft {
  public:
    static constexpr std::size_t shortest = 8;
    /// Columns are taken this many together; parts that lie apart are as many real ones followed by the imaginary ones.
    static constexpr std::size_t together = 16;

    /// Whether this processor has vectors for it, the length is one of those, and no columns are left over.
    static bool can(std::size_t length, std::size_t columns);

    explicit ColumnFft(std::size_t length);

    /// Sums with e^{+2πi jm/n}, or e^{-2πi jm/n} if forward. Row r of the columns begins at from + r·from_row and goes
    /// to to + r·to_row, counted in numbers; both may be the same place.
    void transform(bool forward, const std::complex<float>* from, std::size_t from_row, std::complex<float>* to,
                   std::size_t to_row, std::size_t columns) const;

    /// Sums with e^{+2πi jm/n} down sixteen columns whose parts lie apart, in place: [row][part][column], at a multiple
    /// of a cache line.
    void backward_apart(float* columns) const;

    /// The same down many columns [column/16][row][part][column mod 16], whose results lie like those of transform().
    /// Where rows begin at cache lines and are part of a larger array, results pass by the caches.
    void backward_apart(const float* from, std::complex<float>* to, std::size_t to_row, std::size_t columns) const;

    struct Factor {
        float re, im;
    };
    struct Plan {
        std::size_t length;
        std::vector<std::uint32_t> order;  // the frequency at each place after the last step
        std::vector<Factor>
            factors[2];  // w^j, w^2j, w^3j for each j of each step by four but the last; backward, forward
    };

  private:
    Plan plan_;
};

}  // namespace hogel::math
