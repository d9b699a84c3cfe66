// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

#include "hogel/geometry.h"

namespace hogel::direct {

/// Line that emits coherently, with a phase that is linear along it.
struct LineSource {
    Vec3 a, b;             ///< both behind the hologram or both in front of it, metres
    double amplitude = 1;  ///< of the spherical waves from one metre of the line, at unit distance
    double slope = 0;   ///< of the phase along the line, over k, −1 < slope < 1: light leaves the line at the angle
                        ///< acos(slope), or arrives at it if the line is in front of the hologram
    double cycles = 0;  ///< phase at a, cycles
};

/// Returns the wave of a line at a point of the hologram, ∫ amplitude · e^{±ik(r + slope·l)}/r dl, in closed form. The
/// path is expanded to second order around its stationary point, which gives a Fresnel integral. Source: Frère,
/// Leseberg and Bryngdahl, "Computer-generated holograms of three-dimensional objects composed of line segments", JOSA
/// A 3, 1986.
std::complex<double> line_wave(const LineSource& line, Vec3 position, double wavelength);

}  // namespace hogel::direct
