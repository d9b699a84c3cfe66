// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <memory>

#include "hogel/array.h"

namespace hogel::math {

/// Discrete Fourier transforms of one size, planned once and used from any number of threads. Neither direction is
/// normalised: forward sums with e^{-2πi jm/n}, backward with e^{+2πi jm/n}. A plan depends on the size alone and never
/// on timings, so that equal input gives equal bytes in every run and for any number of threads.

/// A transform of one line.
class Fft1 {
  public:
    /// Throws Error(usage) for an empty size.
    explicit Fft1(std::size_t size);
    ~Fft1();
    Fft1(Fft1&&) noexcept;
    Fft1& operator=(Fft1&&) noexcept;

    std::size_t size() const;
    /// Transforms size() values in place; fastest if they are aligned to a cache line.
    void forward(std::complex<float>* line) const;
    void backward(std::complex<float>* line) const;

  private:
    friend void transform_rows(View<std::complex<float>, 2> values, const Fft1& fft, bool forward);
    friend void transform_columns(View<std::complex<float>, 2> values, const Fft1& fft, bool forward);
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

/// A transform along both axes of an array. Large arrays are transformed by all threads together.
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
    /// As above, but writes row r of the result to to + r·to_row; `values` is overwritten.
    void backward(View<std::complex<float>, 2> values, std::complex<float>* to, std::size_t to_row) const;

    std::size_t height() const;
    std::size_t width() const;

  private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

/// Transforms all rows, or all columns, of an array, on all threads. Throws Error(internal) if the plan has another
/// size.
void transform_rows(View<std::complex<float>, 2> values, const Fft1& fft, bool forward);
void transform_columns(View<std::complex<float>, 2> values, const Fft1& fft, bool forward);

/// The smallest size from n on without a prime factor above 7; such sizes transform fast.
std::size_t good_fft_size(std::size_t n);

}  // namespace hogel::math
