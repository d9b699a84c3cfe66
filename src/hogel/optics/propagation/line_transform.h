// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "hogel/math/fft.h"

namespace hogel::optics::propagation {

/// Equidistant positions or frequencies along an axis: first + i·step.
struct Steps {
    double first = 0, step = 0;
    std::size_t count = 0;
};

/// Computes X_j = scale · Σ_i x_i e^{±2πi a_i b_j} for equidistant a_i and b_j. If the product of the steps is 1/n, a
/// Fourier transform of n values computes the sums. Otherwise the chirp-z transform does: with ν = step_a·step_b and ij
/// = (i² + j² − (j − i)²)/2 the sum is a convolution with e^{∓πiνk²}. All phases are reduced to cycles in double
/// precision. Source: Bluestein, "A linear filtering approach to the computation of discrete Fourier transform", IEEE
/// Trans. Audio Electroacoustics 18, 1970; Rabiner, Schafer and Rader, "The chirp z-transform algorithm", 1969.
class LineTransform {
  public:
    /// @param sign       sign of the exponent
    /// @param transform  n as above, or 0 for the chirp-z transform
    LineTransform(const Steps& from, const Steps& to, int sign, double scale, std::size_t transform);

    std::size_t inputs() const { return input_factors_.size(); }
    std::size_t outputs() const { return output_factors_.size(); }
    /// Returns the number of values that a line buffer must hold.
    std::size_t buffer() const;
    /// Transforms a line in place: inputs and outputs begin at line[0]. `line` holds buffer() values.
    void operator()(std::span<std::complex<float>> line) const;

    /// Returns the FFT size of a chirp-z transform with these numbers of inputs and outputs.
    static std::size_t convolution(std::size_t inputs, std::size_t outputs);
    /// Returns the number of floating-point operations for one line.
    static double operations(std::size_t inputs, std::size_t outputs, std::size_t transform);

  private:
    void by_transform(std::span<std::complex<float>> line) const;
    void by_convolution(std::span<std::complex<float>> line) const;

    math::Fft1 fft_;
    bool forward_, convolves_;
    std::vector<std::complex<float>> input_factors_, output_factors_;
    std::vector<std::complex<float>> chirp_;  // transform of the convolution kernel, fft_.size() frequencies
};

}  // namespace hogel::optics::propagation
