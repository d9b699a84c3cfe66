// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/optics/pupil_edge.h"
#include "hogel/optics/spectrum.h"

namespace hogel::optics {

/// A circular opening: sets the wave to zero outside. The edge limits how far it diffracts light.
void circular_aperture(Wave& wave, double center_x, double center_y, double diameter, const PupilEdge& edge);

/// Multiplies by |q − p|²/|c − p|² at a distance q − c from the centre, for a point p at `path` from the centre. A wave
/// that is propagated to p weighs each point q of an opening by cos θ/|q − p|, and cos θ is inverse to |q − p|; a lens
/// that images p weighs all alike.
void weigh_alike(Wave& wave, double center_x, double center_y, Vec3 path);

/// A rectangular opening, whose edge falls over one sample.
void rectangular_aperture(Wave& wave, const Rectangle& opening);

/// A thin lens with its opening: e^{−ik a²/2l} at a distance a from the centre ([K] 6.12 less a constant phase). A
/// positive focal length gathers light. Throws Error(usage) for a focal length of zero, and for a lens whose phase is
/// too steep at its edge for the wave's samples, naming the diameter that suffices.
void thin_lens(Wave& wave, double center_x, double center_y, double diameter, double focal_length);

}  // namespace hogel::optics
