// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <vector>

#include "hogel/array.h"
#include "hogel/math/fft.h"

namespace hogel::stereogram {

/// Sums of plane waves of any frequencies over a square of n×n samples, at the cost of an FFT of twice the side: each
/// wave is spread over 6×6 frequencies of a finer grid by a Kaiser–Bessel kernel, by whose transform the result is
/// divided at the end (a nonuniform FFT of type 1). Error: about 1e-5 of the largest sum of amplitudes.
class PlaneWaveSum {
  public:
    explicit PlaneWaveSum(std::size_t samples);

    /// The spectrum to be filled with add(): [2n][2n], zero at first.
    Array<std::complex<float>, 2> make_spectrum() const;

    /// Adds amplitude · e^{2πi (column_frequency·p + row_frequency·q)} at sample (column p, row q), both counted from
    /// the middle of the square; frequencies in cycles per sample, at most 1/2.
    void add(std::complex<float> amplitude, double column_frequency, double row_frequency,
             View<std::complex<float>, 2> spectrum) const;

    /// Transforms the spectrum, which is overwritten, and writes the n×n samples.
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
