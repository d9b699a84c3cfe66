// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace hogel::math {

/// Discrete Fourier transforms of sixteen adjacent lines, in place and without reordering. The layout is
/// [position][part][line], part = real, imaginary. Uses hogel's own transforms, independently of HOGEL_FFT.
class SplitFft {
  public:
    static constexpr std::size_t together = 16;
    /// Number of floats between positions.
    static constexpr std::size_t row = 2 * together;

    /// Throws Error(internal) for a size with a prime factor above 13.
    explicit SplitFft(std::size_t size);
    ~SplitFft();
    SplitFft(SplitFft&&) noexcept;
    SplitFft& operator=(SplitFft&&) noexcept;

    std::size_t size() const;
    /// Transforms the lines: X[m] = Σ_j x[j] e^{-2πi jm/n} with n = size(). X[m] is at position place(m). If the caller
    /// swaps real and imaginary parts in input and output, the sign of the exponent is positive.
    /// @param lines  size() · row floats, aligned to a cache line
    void transform(float* lines) const;
    /// Returns the position of frequency m = `frequency` in the result.
    std::uint32_t place(std::size_t frequency) const;

  private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

}  // namespace hogel::math
