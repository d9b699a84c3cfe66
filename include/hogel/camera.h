// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/export.h"
#include "hogel/geometry.h"

namespace hogel {

/// A camera for photographs of light fields and of holograms. The film is parallel to the hologram and shifted as in a
/// view camera, so that pixel (column, row) looks from `eye` through the point (picture.x(column), picture.y(row), 0)
/// of the hologram plane: the hologram is framed alike from every eye.
struct Camera {
    Vec3 eye{0, 0, 0.3};     ///< centre of the lens, metres; z > 0
    double focus_depth = 0;  ///< ζ of the plane in focus, metres: 0 on the hologram plane, positive behind it; > -eye.z
    double focus_slope_x = 0, focus_slope_y = 0;  ///< dζ/dx and dζ/dy of that plane; not zero with a tilted film
    double pupil = 5e-3;  ///< diameter of the lens opening, a disc parallel to the hologram, metres
    Grid picture;         ///< the pixels, projected from the eye onto the hologram plane

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// On the line of sight through the point (x, y) of the hologram plane: the distance from the eye to the plane in
/// focus, divided by the distance from the eye to that point. The plane in focus is ζ = focus_depth + focus_slope_x x +
/// focus_slope_y y. Where it is parallel to the hologram, the ratio is 1 + focus_depth/eye.z; where it is not in front
/// of the eye, the ratio is not positive.
HOGEL_API double focus_ratio(const Camera& camera, double x, double y);

/// Throws Error(usage), naming what is wrong: an eye on or behind the hologram, a plane in focus that lies behind the
/// eye for a part of the picture, no pixels, or no pupil.
HOGEL_API void validate(const Camera& camera);

}  // namespace hogel
