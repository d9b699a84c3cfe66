#pragma once

#include <complex>
#include <cstddef>
#include <memory>

#include "hogel/core/array.h"

namespace hogel {

/// A two-dimensional discrete Fourier transform of one size, planned once and used from any number of threads.
/// Neither direction is normalised: forward sums with e^{-2πi jm/n}, backward with e^{+2πi jm/n}.
/// The plan depends on the size alone, never on timings, so equal input gives equal bytes in every run.
class Fft2 {
  public:
    /// Throws Error(usage) for an empty size.
    Fft2(std::size_t height, std::size_t width);
    ~Fft2();
    Fft2(Fft2&&) noexcept;
    Fft2& operator=(Fft2&&) noexcept;

    /// Transforms in place; the shape is that of the plan.
    void forward(View<std::complex<float>, 2> values) const;
    void backward(View<std::complex<float>, 2> values) const;

    std::size_t height() const;
    std::size_t width() const;

  private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

/// The smallest n' >= n that has no prime factor above 7: sizes that transform fast.
std::size_t good_fft_size(std::size_t n);

}  // namespace hogel
