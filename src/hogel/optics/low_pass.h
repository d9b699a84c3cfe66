// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hogel::optics {

/// Kaiser-windowed sinc for decimation and resampling in the pupil-band camera. Arguments are in output samples. It
/// passes |f| <= 1/4 cycle per sample and stops |f| >= 3/4: a signal that fills half the band is kept, and its aliases
/// are removed. Passband ripple and stopband leakage are below 1e-3.5.
struct LowPass {
    static constexpr double half_width = 4.5;  ///< the kernel is zero beyond this number of samples
    static constexpr double pass = 0.25;       ///< cycles per sample
    static constexpr double stop = 0.75;

    /// Returns the kernel at a distance from its centre. The integral of the kernel is 1.
    static double at(double distance);
};

/// Returns sinc(distance) in a Kaiser window of 72.6 dB, zero beyond `half_width`. The transition band, centred at half
/// a cycle per sample, has a width of 2.25 / half_width cycles per sample.
double kaiser_sinc(double distance, double half_width);

}  // namespace hogel::optics
