// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hogel/codec/format/tone_curve.h"

namespace hogel::codec::encode {

// Returns the tone curve of histogram adjustment (Ward Larson, Rushmeier and Piatko, "A visibility matching tone
// reproduction operator for high dynamic range scenes", IEEE TVCG 3(4), 1997): the cumulative distribution of the
// logarithm of luminance, scaled to a number of decades. Its slope is nowhere above 1 (proportional to luminance); the
// excess of a bin above this ceiling is distributed over all others. Two changes make the curve invertible: a tenth of
// the samples is treated as evenly distributed over the logarithm, and luminances more than six decades below the
// highest are mapped proportionally. The highest luminance is kept. Returns nullopt if the luminances span no more
// decades than `decades`.
std::optional<format::ToneCurve> tone_curve_of(const format::LuminanceHistogram& histogram, double decades);

}  // namespace hogel::codec::encode
