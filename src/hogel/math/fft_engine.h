// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <memory>

namespace hogel::math {

/// What fft.cpp needs of a library of Fourier transforms: those of the lines of an array, by one thread. Either hogel's
/// own (fft_builtin.cpp) or FFTW's (fft_fftw.cpp), chosen by HOGEL_FFT when hogel is built.
class LineEngine {
  public:
    /// Lines that rows() and columns() take at most.
    static constexpr std::size_t together = 16;

    explicit LineEngine(std::size_t size);
    ~LineEngine();
    LineEngine(LineEngine&&) noexcept;
    LineEngine& operator=(LineEngine&&) noexcept;

    std::size_t size() const;
    /// Transforms size() values in place.
    void line(bool forward, std::complex<float>* line) const;
    /// Transforms lines in place that begin `stride` values apart.
    void rows(bool forward, std::complex<float>* lines, std::size_t stride, std::size_t count) const;
    /// Transforms neighbouring columns in place, whose rows begin `row` values apart.
    void columns(bool forward, std::complex<float>* columns, std::size_t row, std::size_t count) const;

  private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

/// Transforms of a small array as a whole, by one thread: along both axes, or along its rows alone.
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
