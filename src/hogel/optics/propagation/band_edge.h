// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace hogel::optics::propagation {

/// Quadrature weights for an integral over frequencies that ends at a sharp band edge. The trapezoidal rule of step 1
/// over the frequencies −∞ … 0, with half the weight at 0, integrates e^{2πift} to ½ cot(πt)/i instead of 1/(2πit). The
/// sum of c_k e^{2πikt} over k = −max_beyond … max_beyond around the edge is a least-squares correction over a range of
/// t.
struct BandEdge {
    static constexpr std::ptrdiff_t max_beyond = 12;
    std::vector<std::complex<double>> corrections;  ///< c_k, k = −max_beyond …
    double error = 0;                               ///< root mean square of the residual over the range

    /// @param low, high  the range of t, in (−1, 1) and shorter than 1
    BandEdge(double low, double high);
};

}  // namespace hogel::optics::propagation
