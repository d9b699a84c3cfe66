// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/geometry.h"

namespace hogel {

/// How a photograph is taken, the same for waves and for rays. The film is parallel to the hologram and shifted as in a
/// view camera, so that the picture is that of the hologram plane seen through the centre of the lens: every eye
/// frames the hologram alike. Pixel (column, row) looks along the line from `eye` through
/// (picture.x(column), picture.y(row), 0).
struct Camera {
    Vec3 eye{0, 0, 0.3};     ///< centre of the lens, metres; z > 0
    double focus_depth = 0;  ///< ζ of the plane in focus: 0 the hologram plane, positive behind it; > -eye.z
    double focus_slope_x = 0, focus_slope_y = 0;  ///< of that plane, dζ/dx and dζ/dy: what a tilted film does
    double pupil = 5e-3;  ///< diameter of the lens opening, metres; the opening is a disc parallel to the hologram
    Grid picture;         ///< pixels laid over the hologram plane
};

/// How many times as far from the eye as the hologram's point (x, y) lies what is in focus in its line of sight: 1 +
/// ζ/R where the plane in focus, ζ = focus_depth + slope_x x + slope_y y, is parallel to the hologram. Not positive
/// where that plane is not in front of the eye.
double focus_ratio(const Camera& camera, double x, double y);

/// Throws Error(usage) naming what is wrong: an eye on or behind the hologram, a focus behind the eye somewhere in the
/// picture, no pixels, no pupil.
void validate(const Camera& camera);

}  // namespace hogel
