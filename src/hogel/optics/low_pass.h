// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hogel::optics {

/// A Kaiser-windowed sinc: the kernel with which the narrow-band camera lowers sampling rates and moves samples.
/// Arguments count output samples. It passes |f| <= 1/4 cycle a sample unchanged and stops |f| >= 3/4, so that a signal
/// that fills half the band survives and what folds back onto it does not: pass ripple and stop leakage below 1e-3.5.
struct LowPass {
    static constexpr double half_width = 4.5;  ///< the kernel vanishes beyond this many samples
    static constexpr double pass = 0.25;       ///< cycles a sample
    static constexpr double stop = 0.75;

    /// The kernel at a distance from its centre; its integral is 1.
    static double at(double distance);
};

}  // namespace hogel::optics
