// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/light_field.h"

namespace hogel::stereogram {

/// Returns the sine of the steepest direction on the axes of a light field; steeper frequencies in the corners of the
/// field of view are omitted. On a frequency grid: that of the outermost frequency, half a step inside the edge.
double steepest_sine(const LightFieldGrid& light_field);

/// Returns the number of samples across a hogel at a pitch, rounded.
std::size_t samples_per_hogel(const LightFieldGrid& light_field, double pitch);

/// Returns the largest sample pitch that diffracts this wavelength to the edge of the light field, λ/(2 sin θ), metres.
double max_pitch(const LightFieldGrid& light_field, double wavelength);

}  // namespace hogel::stereogram
