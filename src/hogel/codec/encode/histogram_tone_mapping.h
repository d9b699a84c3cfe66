// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hogel/codec/format/tone_curve.h"

namespace hogel::codec::encode {

// The tone curve of histogram adjustment (Ward Larson, Rushmeier and Piatko, "A visibility matching tone reproduction
// operator for high dynamic range scenes", IEEE TVCG 3(4), 1997): the cumulative distribution of the logarithm of
// luminance, scaled to a number of decades. It is nowhere steeper than proportional to luminance; what this ceiling
// takes from a bin is shared by all others. Two changes make it invertible: a tenth of the samples counts as spread
// evenly over the logarithm, and luminances more than six decades below the highest are mapped in proportion. The
// highest luminance is kept. Returns nothing if the luminances span no more decades than `decades`.
std::optional<format::ToneCurve> tone_curve_of(const format::LuminanceHistogram& histogram, double decades);

}  // namespace hogel::codec::encode
