// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/array.h"

namespace hogel::camera::speckle_free {

/// Frequencies y_q of the node waves of a hogel, along one axis: half a cycle apart around the pupil and farther apart
/// beyond. PsfBasis expands the PSFs of all waves in the PSFs of these.
class PsfNodes {
  public:
    /// @param samples    n, of a hogel
    /// @param half_band  κ_m, half the width of the pupil, in cycles per hogel
    PsfNodes(std::size_t samples, double half_band);

    std::size_t samples() const { return samples_; }
    std::size_t count() const { return nodes_.size(); }
    double node(std::size_t q) const { return nodes_[q]; }

    /// Number of waves that are processed together; weights are padded with zeros beyond count().
    static constexpr std::size_t lanes = 16;
    static constexpr std::size_t padded_to_lanes(std::size_t numbers) { return (numbers + lanes - 1) / lanes * lanes; }
    std::size_t padded_count() const { return padded_to_lanes(count()); }
    /// Returns the number of points of the pupil at which PSFs are compared.
    std::size_t points() const;
    /// Returns the number of products that the constructor of a PsfBasis computes.
    double products() const;

  private:
    std::size_t samples_;
    double half_band_;
    std::vector<double> nodes_;
};

/// Basis of the PSFs of all waves of a hogel, along one axis.
///
/// A wave of frequency y, in cycles per hogel after demodulation towards the viewpoint, has an intensity on the film
/// that is quadratic in its light D(y − κ) over the pupil |κ| ≤ κ_m. Products of two such lights are band-limited in y,
/// because a hogel is a window. So the products of any y are sums of those of a few y_q, half a cycle apart around the
/// pupil and farther apart beyond:
///
///     D(y − κ) D(y − κ') ≈ Σ_q b_q(y) D(y_q − κ) D(y_q − κ'),
///
/// by least squares over κ and κ'. The inner product of two such functions is the square of the inner product of D(y −
/// κ) and D(y' − κ).
class PsfBasis : public PsfNodes {
  public:
    PsfBasis(std::size_t samples, double half_band);

    /// b_q(m + ν) for m = 0 … n−1, with ν rounded to a 128th. The weights of wave m begin at first + m · stride.
    struct Weights {
        const float* first;
        std::size_t stride;
    };
    Weights weights(double frequency) const;

    static constexpr std::size_t fractions = 128;

    /// Returns the relative error of the products, root mean square over waves of all frequencies.
    double error() const { return error_; }

  private:
    double error_ = 0;
    Array<float, 3> table_;  // [fraction of ν][0 … 2n − 1][q]
};

}  // namespace hogel::camera::speckle_free
