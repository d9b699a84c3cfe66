// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/optics/pupil_edge.h"
#include "hogel/optics/spectrum.h"

namespace hogel::optics {

/// Multiplies a wave by a circular aperture with a soft edge. The edge limits the angle to which it diffracts light.
void circular_aperture(Wave& wave, double center_x, double center_y, double diameter, const PupilEdge& edge);

/// Multiplies a wave at each point q by |q − p|²/|c − p|², with the centre c of an aperture and the point p = c + path.
/// Propagation to p weights each point q by cos θ/|q − p|, and cos θ is inverse to |q − p|. A lens that images p
/// weights all points equally; this factor makes the weights equal.
void weigh_alike(Wave& wave, double center_x, double center_y, Vec3 path);

/// Multiplies a wave by a rectangular aperture with an edge one sample wide.
void rectangular_aperture(Wave& wave, const Rectangle& opening);

/// Multiplies a wave by a thin lens with its aperture: e^{−ik a²/2l} at a distance a from the centre ([K] 6.12 less a
/// constant phase). A positive focal length focuses light. Throws Error(usage) for a focal length of zero. Throws
/// Error(usage) if the samples undersample the phase at the edge; the message gives the largest diameter.
void thin_lens(Wave& wave, double center_x, double center_y, double diameter, double focal_length);

}  // namespace hogel::optics
