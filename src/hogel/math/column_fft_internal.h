#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hogel {

/// Transforms of columns whose length is a power of two, a vector of neighbouring columns at a time: nothing is ever
/// shuffled but the two parts of a number. Decimation in frequency by fours, with a last step by two where the length
/// is no power of four, on a copy of some columns that fits into the nearest cache.
class ColumnFft {
  public:
    static constexpr std::size_t shortest = 8;
    /// Columns of numbers are taken together up to this many; a multiple of it leaves none over.
    static constexpr std::size_t together = 16;

    /// Whether this processor has vectors for it and the length is one of those.
    static bool can(std::size_t length, std::size_t columns);

    explicit ColumnFft(std::size_t length);

    /// Sums with e^{+2πi jm/n}, or e^{-2πi jm/n} if forward. Row r of the columns begins at from + r·from_row and goes
    /// to to + r·to_row, counted in numbers; both may be the same place.
    void transform(bool forward, const std::complex<float>* from, std::size_t from_row, std::complex<float>* to,
                   std::size_t to_row, std::size_t columns) const;

    // A factor as vectors multiply with it: x·re + swapped x·im.
    struct Factor {
        alignas(16) float re[4];
        float im[4];  // −, +, −, +
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

}  // namespace hogel
