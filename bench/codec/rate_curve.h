// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hogel/codec/tile_coder.h"
#include "hogel/light_field.h"

namespace hogel::bench {

/// Light field coded with one quality. Speeds are million samples per processor second, which other work hardly
/// affects.
struct RatePoint {
    double pixels_per_bit, sqnr, encoding, decoding;
};

/// Coder at several qualities, from the best to the worst.
struct RateCurve {
    std::string name;
    std::vector<RatePoint> points;

    /// Return the point with this SQNR, or this number of pixels per bit, interpolated linearly in SQNR and in the
    /// logarithms of the others. Empty if it is outside the range of the points.
    std::optional<RatePoint> at(double sqnr) const;
    std::optional<RatePoint> at_rate(double pixels_per_bit) const;
};

struct QualityRange {  // SQNR, decibels
    double low, high;
};

/// Measures one of the library's coders with decreasing quantiser steps until the range is covered. Throws
/// Error(cancelled) after an interrupt.
RateCurve measure_method(const LightFieldBuffer& field, const CodingMethod& method, const QualityRange& range);

}  // namespace hogel::bench
