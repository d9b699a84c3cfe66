// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

namespace hogel::coding {

/// The quantiser of the zerotree coders: magnitudes in (k·step, (k+1)·step] are level k, so level 0 is twice as wide as
/// the others. Half-open in this direction so that the largest magnitude T = 2^n · step has an n-bit level, as the
/// zerotrees' p_n = ⌊log2(T/|x|)⌋ wants.
class Quantiser {
  public:
    explicit Quantiser(double step) : step_(step), per_step_(1 / step) {}
    double step() const { return step_; }
    /// @param value   not beyond 2³² steps
    std::uint32_t level(float value) const {
        const double steps = std::abs(value) * per_step_;
        const auto whole = static_cast<std::uint32_t>(steps);
        return whole - (whole > 0 && whole == steps);
    }
    /// The middle of a level's interval, 0 for level 0.
    float value(std::uint32_t level, bool negative) const {
        const double magnitude = level == 0 ? 0 : (level + 0.5) * step_;
        return static_cast<float>(negative ? -magnitude : magnitude);
    }

  private:
    double step_, per_step_;
};

/// Σ f², and Σ (f − f')² when f is quantised with a step.
double energy(std::span<const float> values);
double squared_error(std::span<const float> values, double step);

/// The largest step (to 0.1%) that keeps 10 log10(Σ f² / Σ (f − f')²) at `sqnr` decibels or above. Of coefficients in
/// near-orthonormal scaling that is about the SQNR of what they stand for. Anything but 0 < sqnr <= 130 throws
/// Error(usage): floats themselves hold no more. All zeros: any step.
double step_for_sqnr(std::span<const float> values, double sqnr);

/// The largest magnitude. Throws Error(usage) when a value is not finite.
float max_magnitude(std::span<const float> values);

}  // namespace hogel::coding
