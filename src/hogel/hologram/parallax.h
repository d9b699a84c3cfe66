// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/light_field.h"

namespace hogel::hologram {

/// The parallax between neighbouring directions, in samples, that overlapping windows bear: beyond it the windows that
/// show one point no longer touch, and its focus gets side lobes.
inline constexpr double max_parallax = 4;

/// How far, in samples of a hologram of this pitch, neighbouring directions see the same surface apart: |ζ|ΔU/Δ for the
/// largest depth that some hogels spread over the light field meet. Zero without depth.
double neighbouring_parallax(const LightFieldSource& light_field, double pitch);

}  // namespace hogel::hologram
