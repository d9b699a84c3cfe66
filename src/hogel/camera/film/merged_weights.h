// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/camera/film/line_shares.h"

namespace hogel::camera::film {

/// The weights, by TwelvePoint interpolation, of some points of lines that lie side by side, together: those of the sum
/// over all points of factor · the value there. From line to line places and factors change little (line_shares.h).
class MergedWeights {
  public:
    struct Point {
        double low, high;  ///< places on the first and the last line, between which they change in proportion to t
        float low_factor, high_factor;
    };
    /// Whether the points can share weights: no place differs by more than max_line_spread. Points without neighbours,
    /// beyond the ends of the lines, count as zero.
    /// @param size  samples of a line
    bool set(std::span<const Point> points, std::size_t size);

    std::size_t first() const { return first_; }  ///< the first sample that counts
    std::size_t taps() const { return taps_; }    ///< samples that count
    std::size_t nodes() const { return nodes_; }
    /// The weights at a node, one for each tap.
    const float* weights(std::size_t node) const { return weights_.data() + node * stride(); }

  private:
    static constexpr std::size_t room = 16;  // floats beyond the last tap
    std::size_t stride() const { return taps_ + room; }

    std::size_t first_ = 0, taps_ = 0, nodes_ = 0;
    std::vector<Point> inside_;
    std::vector<float> weights_;  // [node][tap]
};

/// Adds the weights of points at a node, of samples from `first` on, to to[tap]; up to sixteen values beyond the last
/// tap are changed. Plain and fast twins agree to rounding.
void add_weights_plain(std::span<const MergedWeights::Point> points, std::size_t node, std::size_t nodes,
                       std::size_t first, float* to);
extern decltype(add_weights_plain)& add_weights;

/// out[line] = the sum over the taps of weights(t[line]) · values[tap][line], of sixteen lines side by side.
/// Plain and fast twins agree to rounding.
/// @param values  the first sample of the lines, not that of the weights
void sum_merged_plain(const float* values, const MergedWeights& weights, const float* t, float* out);
extern decltype(sum_merged_plain)& sum_merged;

}  // namespace hogel::camera::film
