// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace hogel::math {

/// Discrete Fourier transforms of sixteen lines side by side, for code that keeps them so: [position][part][line], the
/// parts real and imaginary. In place and without sorting. By hogel's own transforms, whatever HOGEL_FFT says.
class SplitFft {
  public:
    static constexpr std::size_t together = 16;
    /// Floats from one position to the next.
    static constexpr std::size_t row = 2 * together;

    /// Throws Error(internal) for a size with a prime factor above 13.
    explicit SplitFft(std::size_t size);
    ~SplitFft();
    SplitFft(SplitFft&&) noexcept;
    SplitFft& operator=(SplitFft&&) noexcept;

    std::size_t size() const;
    /// Sums with e^{-2πi jm/n}. If the parts are exchanged, imaginary before real, so are those of the result, and the
    /// sums are those with e^{+2πi jm/n}.
    /// @param lines  aligned to a cache line
    void transform(float* lines) const;
    /// The position of a frequency in the result.
    std::uint32_t place(std::size_t frequency) const;

  private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

}  // namespace hogel::math
