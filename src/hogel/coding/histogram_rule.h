// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hogel::coding {

/// The largest magnitude. Throws Error(usage) if a value is not finite.
float max_magnitude(std::span<const float> values);

/// The rule of [K] 4.4.2 that predicts the size of zerotrees from a histogram h of magnitudes: a significant
/// coefficient whose level has n = b_max − p bits takes n + c of them, where c stands for the trees, so that all take
/// Σ_{p < b_max} h(p) (b_max − p + c). Histograms of the tiles of a light field are added. Magnitudes are counted in 32
/// nearly uniform bins an octave, the bits of floats without their 18 lowest.
class MagnitudeHistogram {
  public:
    MagnitudeHistogram();
    /// Throws Error(usage) if a value is not finite.
    void add(std::span<const float> values);
    void add(const MagnitudeHistogram& other);
    float max() const { return max_; }
    const std::vector<std::uint64_t>& counts() const { return counts_; }
    /// The histogram with that maximum and those counts.
    MagnitudeHistogram(float max, std::vector<std::uint64_t> counts) : counts_(std::move(counts)), max_(max) {}

    /// The bits that the rule predicts.
    double bits(double step, double c) const;
    /// The step, to 0.1 %, whose predicted size is `bits`, or the largest magnitude if that has more; 1 without values
    /// other than 0. Beyond [K], whose steps differ by factors of two: bits() is nearly continuous in the step.
    double step(double bits, double c) const;
    /// The step of [K], T_max·2^(−b_max): of b_max from 1 to 29 that whose predicted size is nearest to `bits` as a
    /// ratio.
    double step_of_planes(double bits, double c) const;

  private:
    std::vector<std::uint64_t> counts_;
    float max_ = 0;
};

}  // namespace hogel::coding
