// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hogel/codec/format/tone_curve.h"

namespace hogel::codec::encode {

// The histogram adjustment of Ward Larson, Rushmeier and Piatko ("A visibility matching tone reproduction operator for
// high dynamic range scenes", IEEE TVCG 3(4), 1997): the cumulative distribution of the logarithm of luminance, scaled
// to so many decades, with their ceiling: nowhere is it steeper than in proportion to luminance. What the ceiling takes
// from a bin, all others share. Two things are added, so that it can be inverted: a part of all samples is spread
// evenly over the logarithm, and luminances six decades below the highest are left in proportion. The highest luminance
// stays as it is. Nothing where the luminances span no more decades than are wanted.
std::optional<format::ToneCurve> tone_curve_of(const format::LuminanceHistogram& histogram, double decades);

}  // namespace hogel::codec::encode
