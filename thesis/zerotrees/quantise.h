// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

namespace hogel::zerotrees {

/// Quantiser of the zerotree coders: magnitudes in (k·step, (k+1)·step] are level k, so level 0 is twice as wide as
/// the others. The intervals are closed above so that the largest magnitude T = 2^n · step has a level of n bits, as
/// p_n = ⌊log2(T/|x|)⌋ of the zerotrees requires.
class Quantiser {
  public:
    explicit Quantiser(double step) : step_(step), per_step_(1 / step) {}
    double step() const { return step_; }
    /// @param value   magnitude at most 2³² steps
    std::uint32_t level(float value) const {
        const double steps = std::abs(value) * per_step_;
        const auto integer = static_cast<std::uint32_t>(steps);
        return integer - (integer > 0 && integer == steps);
    }
    /// Returns the middle of a level's interval, 0 for level 0.
    float value(std::uint32_t level, bool negative) const {
        const double magnitude = level == 0 ? 0 : (level + 0.5) * step_;
        return static_cast<float>(negative ? -magnitude : magnitude);
    }

  private:
    double step_, per_step_;
};

/// Returns Σ f².
double energy(std::span<const float> values);
/// Returns Σ (f − f')² of values quantised with a step.
double squared_error(std::span<const float> values, double step);

/// Returns the largest step (to 0.1%) that keeps 10 log10(Σ f² / Σ (f − f')²) at `sqnr` decibels or above; 1 if all
/// values are zero. For nearly orthonormal coefficients this is about the SQNR of the signal. Throws Error(usage)
/// unless 0 < sqnr <= 130, the limit of floats.
double step_for_sqnr(std::span<const float> values, double sqnr);

}  // namespace hogel::zerotrees
