// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>

namespace hogel::stereogram {

/// Table of e^{2πi t} with 4096 steps, for many phases at an accuracy of 67 dB.
class UnitRoots {
  public:
    UnitRoots() {
        for (std::size_t i = 0; i < steps; ++i)
            roots_[i] = std::complex<float>(
                std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(steps)));
    }
    /// @param cycles  of magnitude below 2³⁰
    std::complex<float> operator()(double cycles) const {
        const double nearest = (cycles + whole_cycles) * steps + 0.5;
        return roots_[static_cast<std::size_t>(static_cast<std::int64_t>(nearest)) % steps];
    }

  private:
    static constexpr std::size_t steps = 4096;
    static constexpr double whole_cycles = 0x1p30;  // makes numbers positive, so that truncation is floor
    alignas(64) std::array<std::complex<float>, steps> roots_;
};

}  // namespace hogel::stereogram
