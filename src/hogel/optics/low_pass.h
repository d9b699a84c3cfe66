// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hogel::optics {

/// A Kaiser-windowed sinc, the kernel with which the narrow-band camera decimates and resamples. Arguments are in
/// output samples. It passes |f| <= 1/4 cycle per sample unchanged and stops |f| >= 3/4, so that a signal that fills
/// half the band is kept and its aliases are removed: pass ripple and stop leakage are below 1e-3.5.
struct LowPass {
    static constexpr double half_width = 4.5;  ///< the kernel is zero beyond this number of samples
    static constexpr double pass = 0.25;       ///< cycles per sample
    static constexpr double stop = 0.75;

    /// The kernel at a distance from its centre; its integral is 1.
    static double at(double distance);
};

/// A sinc(distance) in Kaiser's window of 72.6 dB, zero from `half_width` on: the transition between what it passes and
/// what it stops, around half a cycle per sample, is 2.25 / half_width wide.
double kaiser_sinc(double distance, double half_width);

}  // namespace hogel::optics
