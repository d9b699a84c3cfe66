// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/optics/spectrum.h"

namespace hogel::optics {

/// A circular opening: sets the wave to zero outside; the edge falls over one sample. Returns the effective area for
/// the energy of a uniform wave, m²: the sum of squared transmissions times the area of a sample.
double circular_aperture(Wave& wave, double center_x, double center_y, double diameter);

/// A rectangular opening, whose edge falls over one sample.
void rectangular_aperture(Wave& wave, const Rectangle& opening);

/// A thin lens with its opening: e^{−ik a²/2l} at a distance a from the centre ([K] 6.12 less a constant phase). A
/// positive focal length gathers light. Throws Error(usage) for a focal length of zero, and for a lens whose phase is
/// too steep at its edge for the wave's samples, naming the diameter that suffices.
void thin_lens(Wave& wave, double center_x, double center_y, double diameter, double focal_length);

}  // namespace hogel::optics
