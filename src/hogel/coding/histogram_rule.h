// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hogel::coding {

/// Returns the largest magnitude. Throws Error(usage) if a value is not finite.
float max_magnitude(std::span<const float> values);

/// Predicts the size of zerotrees from a histogram of magnitudes ([K] 4.4.2). A magnitude from 2^(n−1) to 2^n quantiser
/// steps takes n + c bits, where c is the overhead of the trees; smaller magnitudes take none. The histogram has 32
/// nearly uniform bins per octave: the bin of a magnitude is its binary32 number without the lowest 18 bits. Histograms
/// of the tiles of a light field can be added.
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

    /// Returns the predicted number of bits for a quantiser step.
    double bits(double step, double c) const;
    /// Returns the smallest step, to 0.1 %, between max() / 2^29 and max() with a predicted size of at most `bits`.
    /// Returns max() if no step is large enough, and 1 if all values are 0. Extends [K], where steps differ by factors
    /// of two: the predicted size is nearly continuous in the step.
    double step(double bits, double c) const;
    /// Returns the step of [K], max() · 2^(−b) with an integer b from 1 to 29: the one with the smallest
    /// |log(bits(step, c) / bits)|. Returns 1 if all values are 0.
    double step_of_planes(double bits, double c) const;

  private:
    std::vector<std::uint64_t> counts_;
    float max_ = 0;
};

}  // namespace hogel::coding
