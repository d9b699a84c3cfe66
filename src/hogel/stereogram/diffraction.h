// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/light_field.h"

namespace hogel::stereogram {

/// The sine of the steepest direction on the axes of a light field; in the corners of the field of view frequencies
/// beyond it are left out. On a frequency grid that of the outermost frequency, half a step inside the edge.
double steepest_sine(const LightFieldGrid& light_field);

/// The samples across a hogel at a pitch, a whole number.
std::size_t samples_per_hogel(const LightFieldGrid& light_field, double pitch);

/// The largest pitch of a hologram's samples, λ/(2 sin θ), that diffracts this wavelength as far as the light field
/// reaches, metres.
double max_pitch(const LightFieldGrid& light_field, double wavelength);

}  // namespace hogel::stereogram
