// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/light_field.h"

namespace hogel::stereogram {

/// Maximum parallax between neighbouring directions for overlapping windows, samples. Beyond it the windows of one
/// point no longer touch, and its focus has side lobes.
inline constexpr double max_parallax = 4;

/// Maximum side of a hogel for smooth surfaces, samples: the field of wider ones is a grating of hogels.
inline constexpr double max_smooth_hogel = 4;

/// Returns the parallax between neighbouring directions, |ζ|ΔU/Δ, in samples of pitch Δ, for the largest depth in 25
/// hogels spread over the light field. Zero without depth.
double neighbouring_parallax(const LightFieldSource& light_field, double pitch);

/// Returns whether rays without a surface show a picture at infinity: in one of 25 hogels spread over the light field
/// they vary by more than 10 % within a channel. Smooth surfaces show only the mean of such a picture. False without
/// depth.
bool has_picture_at_infinity(const LightFieldSource& light_field);

}  // namespace hogel::stereogram
