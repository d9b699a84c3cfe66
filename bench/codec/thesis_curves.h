// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/light_field.h"

namespace hogel::bench {

/// Coding of a lumigraph with one quality.
struct ThesisPoint {
    double pixels_per_bit, sqnr;
    std::optional<double> overhead = {};   ///< c for which [K]'s rule predicts this size: bits per significant value
    std::optional<double> alphabets = {};  ///< ratio of bytes with [K]'s alphabets to bytes bit by bit
    std::optional<double> alphabet_overhead = {};  ///< c with [K]'s alphabets
};

/// Transform and its coder at several rates, by rising pixels per bit.
struct ThesisCurve {
    std::string coder, transform;
    std::string label;  ///< name in the figures of [K]
    std::vector<ThesisPoint> points;
    std::vector<std::vector<float>> slices = {};  ///< a decoded hogel for each point

    /// Returns the SQNR at a rate, interpolated linearly in the logarithm of the rate; NaN outside of the points.
    double at(double pixels_per_bit) const;
    /// Returns the index of the point nearest to a rate.
    std::size_t nearest(double pixels_per_bit) const;
};

struct ThesisMeasurement {
    /// Pixels per bit at which the rule of a histogram is evaluated, rising.
    std::vector<double> rates{0.5, 0.75, 1.4, 2.5, 4.5, 8, 16, 32, 64, 240};
    std::vector<std::string> transforms;  ///< as ThesisCurve::transform; empty: all
    std::size_t hogel = 0;                ///< index of the hogel in slices
};

/// Returns all curves of [K] fig. 4.18 to 4.20 of a lumigraph of one channel, and those of this library's coders:
/// wavelets in three passes, EZW for Haar and D6, the cosine transform with both tables, and the coder hogel. The whole
/// array is transformed at once. Throws Error(cancelled) after an interrupt.
std::vector<ThesisCurve> thesis_curves(const LightFieldBuffer& values, const ThesisMeasurement& measurement);

}  // namespace hogel::bench
