// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/low_pass.h"

#include <cmath>
#include <numbers>

#include "hogel/math/bessel.h"

namespace hogel::optics {

double LowPass::at(double distance) { return kaiser_sinc(distance, half_width); }

double kaiser_sinc(double distance, double half_width) {
    // Kaiser's design: attenuation a = 7.95 + 14.36 · (2·4.5) · Δf = 72.6 dB for a transition Δf = 1/2;
    // β = 0.1102 (a − 8.7).
    constexpr double beta = 7.04;
    const double relative = distance / half_width;
    if (std::abs(relative) >= 1) return 0;
    const double window = math::bessel_i0(beta * std::sqrt(1 - relative * relative)) / math::bessel_i0(beta);
    const double phase = std::numbers::pi * distance;
    return window * (distance == 0 ? 1 : std::sin(phase) / phase);
}

}  // namespace hogel::optics
