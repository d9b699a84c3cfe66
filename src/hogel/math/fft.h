// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <memory>

#include "hogel/array.h"

namespace hogel::math {

/// Discrete Fourier transforms with a plan per size. Thread-safe. forward: X[m] = Σ_j x[j] e^{-2πi jm/n}; backward:
/// with e^{+2πi jm/n}. Neither divides by n. A plan depends only on the size: equal input gives equal bytes for any
/// number of threads.

/// Transform of one line.
class Fft1 {
  public:
    /// Throws Error(usage) for an empty size.
    explicit Fft1(std::size_t size);
    ~Fft1();
    Fft1(Fft1&&) noexcept;
    Fft1& operator=(Fft1&&) noexcept;

    std::size_t size() const;
    /// Transform size() values in place; fastest if aligned to a cache line.
    void forward(std::complex<float>* line) const;
    void backward(std::complex<float>* line) const;

  private:
    friend void transform_rows(View<std::complex<float>, 2> values, const Fft1& fft, bool forward);
    friend void transform_columns(View<std::complex<float>, 2> values, const Fft1& fft, bool forward);
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

/// Transform along both axes of an array. Large arrays use all threads.
class Fft2 {
  public:
    /// Throws Error(usage) for an empty size.
    Fft2(std::size_t height, std::size_t width);
    ~Fft2();
    Fft2(Fft2&&) noexcept;
    Fft2& operator=(Fft2&&) noexcept;

    /// Transform in place. The shape must be that of the plan.
    void forward(View<std::complex<float>, 2> values) const;
    void backward(View<std::complex<float>, 2> values) const;
    /// As backward() in place, but writes row r of the result at to + r·to_row. Overwrites `values`.
    void backward(View<std::complex<float>, 2> values, std::complex<float>* to, std::size_t to_row) const;

    std::size_t height() const;
    std::size_t width() const;

  private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

/// Transform all rows, or all columns, of an array, on all threads. Throw Error(internal) if the plan has another size.
void transform_rows(View<std::complex<float>, 2> values, const Fft1& fft, bool forward);
void transform_columns(View<std::complex<float>, 2> values, const Fft1& fft, bool forward);

/// Returns the smallest size not below n without a prime factor above 7, for fast transforms.
std::size_t good_fft_size(std::size_t n);

}  // namespace hogel::math
