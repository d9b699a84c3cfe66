// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/optics/spectrum.h"

namespace hogel::optics {

/// A circular opening: the wave becomes zero outside; its edge falls over one sample. Returns the area, m², through
/// which the energy of a uniform wave passes: the samples' own, each times its square.
double circular_aperture(Wave& wave, double center_x, double center_y, double diameter);

/// A rectangular opening, whose edge falls over one sample.
void rectangular_aperture(Wave& wave, const Rectangle& opening);

/// A thin lens with its opening: e^{−ik a²/2l} at a distance a from the centre ([K] 6.12 less a constant phase). A
/// positive focal length gathers light. Throws Error(usage) for a focal length of zero, and for a lens towards whose
/// edge the phase is too steep for the wave's samples, with the diameter that would do.
void thin_lens(Wave& wave, double center_x, double center_y, double diameter, double focal_length);

}  // namespace hogel::optics
