// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/light_field.h"

namespace hogel::stereogram {

/// The largest parallax between neighbouring directions, in samples, for overlapping windows. Beyond it the windows
/// that show one point no longer touch, and its focus has side lobes.
inline constexpr double max_parallax = 4;

/// The largest side of a hogel, in samples, of smooth surfaces: the field of wider ones is a grating of hogels.
inline constexpr double max_smooth_hogel = 4;

/// The parallax between neighbouring directions, |ζ|ΔU/Δ, in samples of a hologram of this pitch, for the largest depth
/// of some hogels spread over the light field. Zero without depth.
double neighbouring_parallax(const LightFieldSource& light_field, double pitch);

/// Whether rays of a hogel that meet nothing differ, in some hogels spread over the light field: a picture at infinity.
/// Smooth surfaces show only its mean. False without depth.
bool has_picture_at_infinity(const LightFieldSource& light_field);

}  // namespace hogel::stereogram
