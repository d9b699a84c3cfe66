// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <vector>

#include "hogel/array.h"
#include "hogel/math/fft.h"

namespace hogel::stereogram {

/// Sum of plane waves of arbitrary frequencies over a square of n×n samples, at the cost of an FFT of twice the side
/// (nonuniform FFT of type 1). Each wave is spread over 6×6 frequencies of a finer grid by a Kaiser–Bessel kernel; the
/// result is divided by the kernel's transform. Error: about 1e-5 of the largest sum of amplitudes. Thread-safe.
class PlaneWaveSum {
  public:
    explicit PlaneWaveSum(std::size_t samples);

    /// Returns a zero spectrum for add(), [2n][2n], at least 6×6.
    Array<std::complex<float>, 2> make_spectrum() const;

    /// Adds amplitude · e^{2πi (column_frequency·p + row_frequency·q)} at sample (column p, row q), counted from the
    /// middle of the square. Frequencies are in cycles per sample, at most 1/2.
    void add(std::complex<float> amplitude, double column_frequency, double row_frequency,
             View<std::complex<float>, 2> spectrum) const;

    /// Transforms the spectrum, in place, and writes the n×n samples.
    void transform(View<std::complex<float>, 2> spectrum, View<std::complex<float>, 2> samples) const;

  private:
    static constexpr std::size_t width = 6;
    struct Spread {
        std::size_t first;
        float weights[width];
    };
    Spread spread(double frequency) const;

    std::size_t samples_, size_;
    math::Fft2 fft_;
    std::vector<float> kernel_;      // from its middle outwards
    std::vector<float> correction_;  // reciprocal of the kernel's transform, for each sample along a side
};

}  // namespace hogel::stereogram
