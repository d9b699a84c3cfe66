// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hogel/codec/tile_coder.h"
#include "hogel/light_field.h"

namespace hogel::bench {

/// A light field coded with one quality. Speeds are million samples per second of processor time, so that other work on
/// the machine has little influence.
struct RatePoint {
    double pixels_per_bit, sqnr, encoding, decoding;
};

/// A coder at several qualities, from the best to the worst.
struct RateCurve {
    std::string name;
    std::vector<RatePoint> points;

    /// The point with that SQNR, or that number of pixels per bit, interpolated linearly in SQNR and in the logarithms
    /// of the others. Nothing if it is outside the range of the points.
    std::optional<RatePoint> at(double sqnr) const;
    std::optional<RatePoint> at_rate(double pixels_per_bit) const;
};

/// A range of SQNRs, decibels.
struct QualityRange {
    double low, high;
};

/// Measures one of the library's coders with ever smaller quantiser steps until the range is covered. Throws
/// Error(cancelled) after an interrupt.
RateCurve measure_method(const LightFieldBuffer& field, const CodingMethod& method, const QualityRange& range);

}  // namespace hogel::bench
