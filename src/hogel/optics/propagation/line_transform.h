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

/// X_j = scale · Σ_i x_i e^{±2πi a_i b_j} between any equidistant a_i and b_j. If their steps are those of a Fourier
/// transform of n values, a·b = 1/n, that transform computes the sums; otherwise the chirp-z transform does: with
/// ν = step_a·step_b and ij = (i² + j² − (j − i)²)/2 the sum is a convolution with e^{∓πiνk²}. Source: Bluestein, "A
/// linear filtering approach to the computation of discrete Fourier transform", IEEE Trans. Audio Electroacoustics 18,
/// 1970; Rabiner, Schafer and Rader, "The chirp z-transform algorithm", 1969. All phases are reduced to cycles in
/// double precision.
class LineTransform {
  public:
    /// @param sign      of the exponent
    /// @param transform n as above, or 0 for the chirp-z transform
    LineTransform(const Steps& from, const Steps& to, int sign, double scale, std::size_t transform);

    std::size_t inputs() const { return before_.size(); }
    std::size_t outputs() const { return after_.size(); }
    /// Values that a line buffer must hold.
    std::size_t buffer() const;
    /// Transforms the inputs at the beginning of `line`, which holds buffer() values, into the outputs at its
    /// beginning.
    void operator()(std::span<std::complex<float>> line) const;

    /// The buffer of a chirp-z transform between so many values.
    static std::size_t convolution(std::size_t inputs, std::size_t outputs);
    /// Floating-point operations of a line.
    static double operations(std::size_t inputs, std::size_t outputs, std::size_t transform);

  private:
    void by_transform(std::span<std::complex<float>> line) const;
    void by_convolution(std::span<std::complex<float>> line) const;

    math::Fft1 fft_;
    bool forward_, convolves_;
    std::vector<std::complex<float>> before_, after_;  // factors of inputs and outputs
    std::vector<std::complex<float>> chirp_;  // transform of the convolution's kernel, over fft_.size() frequencies
};

}  // namespace hogel::optics::propagation
