// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace hogel::wavelets {

/// Half of the samples that a lifting step changes: the odd samples, which become details, or the even samples, which
/// become coarse samples. The step reads the other half.
enum class Half { detail, coarse };

/// target[i] += Σ_k taps[k] · source[i + first + k].
/// Beyond an end of the line the source is continued by the polynomial through its last `extension` samples (all if it
/// has fewer; 0: by zeros). With an extension of N samples a step keeps polynomials of degree < N up to the ends.
struct LiftingStep {
    Half target;
    int first;
    std::vector<double> taps;
    int extension;
};

/// Wavelet transform of lines as lifting steps from the lazy wavelet (even samples | odd samples).
///
/// In a name (N,Ñ) the first number is the order of interpolation or polynomial reproduction: the details of
/// polynomials of degree < N vanish. The second is the number of vanishing moments of the other side, due to lifting:
/// the synthesis wavelets are orthogonal to polynomials of degree < Ñ, so dropping details keeps moments 0..Ñ−1 of the
/// signal. N holds up to both ends of a line whose halves have at least as many samples as the extensions of the steps
/// (shorter lines have a lower order); Ñ holds in the interior. The transform is invertible for lines of every length,
/// as is any lifting.
struct Wavelet {
    std::string_view name;
    int reproduction;  // N
    int moments;       // Ñ
    int edge_order;
    std::vector<LiftingStep> steps;
};

/// Returns all wavelets: haar d4 d6 ai13 ai31 ai33 i22 i24 i42 i44 cdf31 cdf33 cdf42 cdf44 cdf97.
std::span<const Wavelet> wavelets();

}  // namespace hogel::wavelets
