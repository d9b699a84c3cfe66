// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>

#include "hogel/optics/film/interpolation.h"

namespace hogel::optics::film {

/// The places on a line of samples at uniform steps of a direction sine: value i is at
/// offset + scale · s/√(square − s²), s = first + i · step.
struct TangentPlaces {
    double first = 0, step = 0, square = 1;
    double scale = 0, offset = 0;
};

/// out[i] = the value of `line` (zero outside) at place i, interpolated by `table`. Plain and fast twins agree to
/// rounding.
void resample_tangents_plain(std::span<const std::complex<float>> line, const TangentPlaces& places,
                             const InterpolationTable& table, std::span<std::complex<float>> out);
void resample_tangents(std::span<const std::complex<float>> line, const TangentPlaces& places,
                       const InterpolationTable& table, std::span<std::complex<float>> out);

}  // namespace hogel::optics::film
