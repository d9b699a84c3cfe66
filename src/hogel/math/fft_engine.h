// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <memory>

namespace hogel::math {

/// Single-threaded transforms of the lines of an array, the interface between fft.cpp and an FFT library: hogel's own
/// (fft_builtin.cpp) or FFTW (fft_fftw.cpp), selected by HOGEL_FFT at build time.
class LineEngine {
  public:
    /// Maximum number of lines of rows() and columns().
    static constexpr std::size_t batch_lines = 16;

    explicit LineEngine(std::size_t size);
    ~LineEngine();
    LineEngine(LineEngine&&) noexcept;
    LineEngine& operator=(LineEngine&&) noexcept;

    std::size_t size() const;
    void line(bool forward, std::complex<float>* line) const;
    /// Transforms lines in place. `stride`: number of values between the starts of lines.
    void rows(bool forward, std::complex<float>* lines, std::size_t stride, std::size_t count) const;
    /// Transforms adjacent columns in place. `row`: number of values between the starts of rows.
    void columns(bool forward, std::complex<float>* columns, std::size_t row, std::size_t count) const;

  private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

/// Single-threaded transforms of a small array, along both axes or along rows only.
class SmallArrayEngine {
  public:
    enum class Axes { both, rows };
    SmallArrayEngine(std::size_t height, std::size_t width, Axes axes);
    ~SmallArrayEngine();
    SmallArrayEngine(SmallArrayEngine&&) noexcept;
    SmallArrayEngine& operator=(SmallArrayEngine&&) noexcept;

    /// Transforms height · width values in place.
    void run(bool forward, std::complex<float>* values) const;

  private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

}  // namespace hogel::math
