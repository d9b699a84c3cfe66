// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/array.h"

namespace hogel::camera::speckle_free {

/// The frequencies y_q of a few waves of a hogel, along one axis, whose spots stand for those of all: half a cycle
/// apart around the pupil and farther apart beyond. See PsfBasis.
class PsfNodes {
  public:
    /// @param samples    n, of a hogel
    /// @param half_band  κ_m, half the width of the pupil, in cycles per hogel
    PsfNodes(std::size_t samples, double half_band);

    std::size_t samples() const { return samples_; }
    /// The number of waves y_q, and the frequency of one.
    std::size_t count() const { return nodes_.size(); }
    double node(std::size_t q) const { return nodes_[q]; }

    /// Waves that are processed together; weights are zero beyond count().
    static constexpr std::size_t lanes = 16;
    static constexpr std::size_t in_lanes(std::size_t numbers) { return (numbers + lanes - 1) / lanes * lanes; }
    std::size_t padded_count() const { return in_lanes(count()); }
    /// Points of the pupil at which spots are compared.
    std::size_t points() const;
    /// Products that a PsfBasis of these waves takes.
    double products() const;

  private:
    std::size_t samples_;
    double half_band_;
    std::vector<double> nodes_;
};

/// The waves whose spots stand for those of all waves of a hogel, along one axis.
///
/// On a film, a wave of frequency y, in cycles per hogel after demodulation towards the eye, has an intensity that is
/// quadratic in its light D(y − κ) over the pupil |κ| ≤ κ_m. Products of two such lights are band-limited in y, because
/// a hogel is a window, so those of any y are sums of those of a few y_q, half a cycle apart around the pupil and
/// farther apart beyond:
///
///     D(y − κ) D(y − κ') ≈ Σ_q b_q(y) D(y_q − κ) D(y_q − κ'),
///
/// by least squares over κ and κ'. The inner product of two such functions is that of D(y − κ) and D(y' − κ), squared.
class PsfBasis : public PsfNodes {
  public:
    PsfBasis(std::size_t samples, double half_band);

    /// b_q(m + ν) for m = 0 … n−1, for ν rounded to a 128th: those of m begin at first + m · stride.
    struct Weights {
        const float* first;
        std::size_t stride;
    };
    Weights weights(double frequency) const;

    static constexpr std::size_t fractions = 128;

    /// The relative error of the products, root mean square over waves of all frequencies.
    double error() const { return error_; }

  private:
    double error_ = 0;
    Array<float, 3> table_;  // [fraction of ν][0 … 2n − 1][q]
};

}  // namespace hogel::camera::speckle_free
