// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/stereogram/stereogram.h"

namespace hogel::camera::hogel_spectra {

/// Numbers that are processed together: hogels, looks, rows of waves, or nodes of a band.
inline constexpr std::size_t lanes = 16;
constexpr std::size_t padded(std::size_t count) { return (count + lanes - 1) / lanes * lanes; }

/// Basis of the light of a hogel within a pupil, along one axis: few coefficients replace the hogel's samples.
///
/// Samples u_j of a hogel, j = 0 … n−1, demodulated towards the viewpoint, send light of frequency κ (cycles per hogel)
/// to a point of the pupil: S(κ) = Σ_j u_j e^{−2πiκ(j−c)/n} with c = (n−1)/2. The pupil is |κ| ≤ κ_m, one or two
/// cycles. In it S is a sum of a few prolate spheroidal functions v_k, the eigenfunctions of the kernel Σ_j
/// e^{2πi(κ−κ')(j−c)/n} over |κ| ≤ κ_m: S(κ) ≈ Σ_k s_k v_k(κ), s_k = ∫ v_k S. They are real, alternately even and odd.
///
/// - A wave e^{2πi(m+ν)(j−c)/n} has the coefficients s_k = D_k(m + ν) = ∫ v_k(κ) D(m+ν−κ) dκ, with Dirichlet's kernel
///   D(y) = sin πy / sin(πy/n).
/// - With a window w_j, the kernel is Σ_j w_j² e^{2πi(κ−κ')(j−c)/n}, and D the transform of the window.
/// - A band with `nodes_per_hogel` samples per hogel has the light s_k v_k if its samples at the nodes b are i^{k mod
///   2} s_k spread(b, k), times the carrier e^{−2πiνx_b} for weights of a frequency ν.
class SlepianBasis {
  public:
    using Window = stereogram::HogelWindow;

    /// @param samples          n
    /// @param nodes_per_hogel  samples of the band per hogel, more than 4 κ_m
    /// @param half_band        κ_m
    /// @param before           minimum number of samples of the band before the hogel
    /// @param tolerance        relative to the strongest: minimum amplitude of a function, and maximum error of the
    ///                         band's samples, for which nodes are added
    SlepianBasis(std::size_t samples, std::size_t nodes_per_hogel, double half_band, Window window = Window::none,
                 std::size_t before = 1, double tolerance = 6e-4);

    std::size_t samples() const { return samples_; }
    std::size_t functions() const { return functions_; }
    /// Number of the band's samples that a hogel reaches, and number of those before the hogel.
    std::size_t nodes() const { return spread_.extent(0); }
    std::size_t before() const { return before_; }
    /// Returns the position of a node from the middle of the hogel, in hogels.
    double position(std::size_t node) const {
        return (static_cast<double>(node) - static_cast<double>(before_) + 0.5) / static_cast<double>(per_hogel_) - 0.5;
    }

    /// Returns the values of the functions at the nodes, [node][function].
    View<const float, 2> spread() const { return spread_; }

    /// Two waves with equal weights for even functions and opposite weights for odd ones. The signs, ±0, flip the
    /// waves; the weights are those of the first.
    struct SymmetricPair {
        std::uint32_t first, second;
        float sign_first, sign_second;
        const float* weights;  ///< [function]
    };

    /// D_k(m + ν) for m = 0 … n−1, with ν rounded to a half. The weights of function k begin at first + k · stride.
    ///
    /// With i = m + ⌊ν⌋ modulo n and the fraction f of ν, the frequencies y = i + f and n − y have the same weights for
    /// even functions and opposite ones for odd functions, up to the sign. Sums and differences of such pairs of waves
    /// need half the products. `pairs` lists them.
    struct Weights {
        double frequency;  ///< ν, rounded
        float sign;        ///< factor of all weights
        const float* first;
        std::size_t stride;
        std::span<const SymmetricPair> pairs;
        std::size_t unpaired;  ///< number of pairs at the end with a single wave
        const float* carrier;  ///< e^{−2πiνx} at the positions x of the nodes: [part][padded(nodes)], padded with zeros
    };
    static constexpr std::size_t fractions = 2;
    Weights weights(double frequency) const;
    /// Equal rounded frequencies have equal weights.
    static double rounded(double frequency) { return std::floor(frequency * fractions + 0.5) / fractions; }

    /// Returns the relative error of S over |κ| ≤ κ_m, root mean square over waves of all frequencies.
    double error() const { return error_; }

  private:
    double window_at(double y) const;
    double square_at(double y) const;
    void tabulate(View<const double, 2> functions, std::span<const double> points,
                  std::span<const double> quadrature_weights);
    void make_pairs();
    void make_carriers();

    std::size_t samples_, per_hogel_, functions_ = 0, before_ = 0;
    Window window_;
    double error_ = 0;
    Array<float, 2> spread_;
    Array<float, 3> table_;                                         // [halves of ν][function][0 … 2n − 1]
    Array<float, 3> folded_;                                        // [halves of ν][0 … n/2][function]
    std::vector<SymmetricPair> pairs_[fractions];                   // [⌊ν⌋][pair], those with one wave last
    Array<float, 3> carriers_;                                      // [steps of ν, over a period][part][node]
    std::size_t count_[fractions] = {}, unpaired_[fractions] = {};  // of one ⌊ν⌋
};

}  // namespace hogel::camera::hogel_spectra
