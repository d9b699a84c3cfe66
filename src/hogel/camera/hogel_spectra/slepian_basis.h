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

/// Numbers that are processed together: hogels, looks, rows of waves, and nodes of a band.
inline constexpr std::size_t lanes = 16;
constexpr std::size_t padded(std::size_t count) { return (count + lanes - 1) / lanes * lanes; }

/// The few numbers that a hogel is worth to an eye, along one axis.
///
/// Samples u_j of a hogel, j = 0 … n−1, demodulated towards the eye, send light of frequency κ (cycles per hogel) to a
/// point of the pupil: S(κ) = Σ_j u_j e^{−2πiκ(j−c)/n} with c = (n−1)/2. Within the pupil |κ| ≤ κ_m, which is one or
/// two cycles, so S is a sum of a few prolate spheroidal functions v_k, the eigenfunctions of the kernel Σ_j
/// e^{2πi(κ−κ')(j−c)/n} over |κ| ≤ κ_m: S(κ) ≈ Σ_k s_k v_k(κ), s_k = ∫ v_k S. They are real, alternately even and odd.
///
/// - A wave e^{2πi(m+ν)(j−c)/n} has the coefficients s_k = D_k(m + ν) = ∫ v_k(κ) D(m+ν−κ) dκ, with Dirichlet's kernel
///   D(y) = sin πy / sin(πy/n).
/// - With a window w_j, the kernel is Σ_j w_j² e^{2πi(κ−κ')(j−c)/n}, and D the transform of the window.
/// - A band of `nodes_per_hogel` samples to a hogel has the light s_k v_k if its samples at the nodes b are
///   i^{k mod 2} s_k spread(b, k), times the carrier e^{−2πiνx_b} where weights are those of a frequency ν.
class SlepianBasis {
  public:
    using Window = stereogram::HogelWindow;

    /// @param samples          n
    /// @param nodes_per_hogel  samples of the band to a hogel, more than 4 κ_m
    /// @param half_band        κ_m
    /// @param before           samples of the band before the hogel, at least
    /// @param tolerance        relative to the strongest, the amplitude below which a function is left out, and the
    ///                         error of the band's samples up to which nodes are added
    SlepianBasis(std::size_t samples, std::size_t nodes_per_hogel, double half_band, Window window = Window::none,
                 std::size_t before = 1, double tolerance = 6e-4);

    std::size_t samples() const { return samples_; }
    std::size_t functions() const { return functions_; }
    /// The samples of the band that a hogel lights, and how many of them are before the hogel.
    std::size_t nodes() const { return spread_.extent(0); }
    std::size_t before() const { return before_; }
    /// The position of a node from the middle of the hogel, in hogels.
    double place(std::size_t node) const {
        return (static_cast<double>(node) - static_cast<double>(before_) + 0.5) / static_cast<double>(per_hogel_) - 0.5;
    }

    /// [node][function]
    View<const float, 2> spread() const { return spread_; }

    /// Two waves whose weights are equal for even functions and opposite for odd ones, with the signs, ±0, with which
    /// they are taken, and the weights of the first.
    struct SymmetricPair {
        std::uint32_t first, second;
        float sign_first, sign_second;
        const float* weights;  ///< [function]
    };

    /// D_k(m + ν) for m = 0 … n−1, for ν rounded to a half: k's weights begin at first + k · stride.
    ///
    /// With i = m + the whole part of ν, modulo n, the frequencies y = i + the fraction and n − y have the same weights
    /// for even functions and opposite ones for odd functions, but for signs. So sums and differences of two waves need
    /// half the products. `pairs` lists the waves so.
    struct Weights {
        double frequency;  ///< ν as rounded
        float sign;        ///< factor of all weights
        const float* first;
        std::size_t stride;
        std::span<const SymmetricPair> pairs;
        std::size_t unpaired;  ///< the last pairs, which have one wave only
        const float* carrier;  ///< e^{−2πiνx} at the nodes' places x: [part][padded(nodes)], 0 beyond them
    };
    static constexpr std::size_t fractions = 2;
    Weights weights(double frequency) const;
    /// The same frequencies have the same weights.
    static double rounded(double frequency) { return std::floor(frequency * fractions + 0.5) / fractions; }

    /// The relative error of S over |κ| ≤ κ_m, root mean square over waves of all frequencies.
    double error() const { return error_; }

  private:
    // Transforms of the window and of its square.
    double window_at(double y) const;
    double square_at(double y) const;
    void tabulate(View<const double, 2> functions, std::span<const double> points, std::span<const double> shares);
    void make_pairs();
    void make_carriers();

    std::size_t samples_, per_hogel_, functions_ = 0, before_ = 0;
    Window window_;
    double error_ = 0;
    Array<float, 2> spread_;
    Array<float, 3> table_;                        // [halves of ν][function][0 … 2n − 1]
    Array<float, 3> folded_;                       // [halves of ν][0 … n/2][function]
    std::vector<SymmetricPair> pairs_[fractions];  // [whole part of ν][pair], those with one wave last
    Array<float, 3> carriers_;                     // [ν in steps, of a period][part][node]
    std::size_t count_[fractions] = {}, unpaired_[fractions] = {};  // of one whole part
};

}  // namespace hogel::camera::hogel_spectra
