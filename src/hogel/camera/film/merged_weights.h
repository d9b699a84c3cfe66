// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/camera/film/line_shares.h"

namespace hogel::camera::film {

/// Combined weights of the samples of a line in a sum over several points, Σ factor · (TwelvePoint interpolation at the
/// point). They apply to parallel lines, with positions and factors that change little from line to line
/// (line_shares.h).
class MergedWeights {
  public:
    struct Point {
        double low, high;  ///< positions on the first and the last line; linear in t between them
        float low_factor, high_factor;
    };
    /// Combines the weights of the points. Returns false if the lines cannot share weights: a position differs by more
    /// than max_line_spread between lines. Points without neighbours, beyond the ends of the lines, count as zero.
    /// @param size  samples of a line
    bool set(std::span<const Point> points, std::size_t size);

    std::size_t first() const { return first_; }  ///< the first sample with a weight
    std::size_t taps() const { return taps_; }    ///< number of samples with weights
    std::size_t nodes() const { return nodes_; }
    const float* weights(std::size_t node) const { return weights_.data() + node * stride(); }

  private:
    static constexpr std::size_t padding = 16;  // floats beyond the last tap
    std::size_t stride() const { return taps_ + padding; }

    std::size_t first_ = 0, taps_ = 0, nodes_ = 0;
    std::vector<Point> inside_points_;
    std::vector<float> weights_;  // [node][tap]
};

/// Adds the weights of points at a node, of samples from `first` on, to to[tap]. It may change up to sixteen values
/// beyond the last tap. Plain and fast twins agree to rounding.
void add_weights_plain(std::span<const MergedWeights::Point> points, std::size_t node, std::size_t nodes,
                       std::size_t first, float* to);
extern decltype(add_weights_plain)& add_weights;

/// Computes out[line], the sum over the taps of weights(t[line]) · values[tap][line], of sixteen interleaved lines.
/// Plain and fast twins agree to rounding.
/// @param values  the first sample of the lines, not that of the weights
void sum_merged_plain(const float* values, const MergedWeights& weights, const float* t, float* out);
extern decltype(sum_merged_plain)& sum_merged;

}  // namespace hogel::camera::film
