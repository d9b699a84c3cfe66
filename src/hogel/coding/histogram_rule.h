// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hogel::coding {

/// Returns the largest magnitude. Throws Error(usage) if a value is not finite.
float max_magnitude(std::span<const float> values);

/// Rule of [K] 4.4.2 that predicts the size of zerotrees from a histogram h of magnitudes. A significant coefficient
/// with a level of n = b_max − p bits takes n + c bits, where c is the overhead of the trees; all coefficients take
/// Σ_{p < b_max} h(p) (b_max − p + c). Histograms of the tiles of a light field are added. Magnitudes are counted in 32
/// nearly uniform bins per octave: the bits of floats without their lowest 18.
class MagnitudeHistogram {
  public:
    MagnitudeHistogram();
    /// Throws Error(usage) if a value is not finite.
    void add(std::span<const float> values);
    void add(const MagnitudeHistogram& other);
    float max() const { return max_; }
    const std::vector<std::uint64_t>& counts() const { return counts_; }
    /// Constructs the histogram from its maximum and counts.
    MagnitudeHistogram(float max, std::vector<std::uint64_t> counts) : counts_(std::move(counts)), max_(max) {}

    /// Returns the bits that the rule predicts.
    double bits(double step, double c) const;
    /// Returns the step, to 0.1 %, with a predicted size of `bits`, or the largest magnitude if its size is larger; 1
    /// if all values are 0. Extends [K], where steps differ by factors of two: bits() is nearly continuous in the step.
    double step(double bits, double c) const;
    /// Returns the step of [K], T_max·2^(−b_max), with b_max from 1 to 29 for which the ratio of the predicted size to
    /// `bits` is nearest to 1.
    double step_of_planes(double bits, double c) const;

  private:
    std::vector<std::uint64_t> counts_;
    float max_ = 0;
};

}  // namespace hogel::coding
