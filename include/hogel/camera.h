// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/export.h"
#include "hogel/geometry.h"

namespace hogel {

/// A camera for photographs of light fields and holograms. The film is parallel to the hologram and shifted as in a
/// view camera, so every viewpoint frames the hologram alike: pixel (column, row) looks from `eye` through the point
/// (picture.x(column), picture.y(row), 0) of the hologram plane.
struct Camera {
    Vec3 eye{0, 0, 0.3};  ///< viewpoint: centre of the lens, metres; z > 0
    /// ζ of the plane in focus on the axis x = y = 0, metres; positive behind the hologram; greater than -eye.z.
    double focus_depth = 0;
    double focus_slope_x = 0, focus_slope_y = 0;  ///< dζ/dx and dζ/dy of the plane in focus; nonzero for a tilted film
    double pupil = 5e-3;  ///< diameter of the lens opening, metres; a disc parallel to the hologram
    Grid picture;         ///< pixels, projected from the viewpoint onto the hologram plane

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// Returns the distance from the viewpoint to the plane in focus, divided by the distance to the point (x, y, 0), both
/// along the line of sight through that point. x and y are in metres. The plane in focus is ζ = focus_depth +
/// focus_slope_x x + focus_slope_y y. If it is parallel to the hologram, the ratio is 1 + focus_depth/eye.z. The ratio
/// is not positive if the plane is not in front of the viewpoint.
HOGEL_API double focus_ratio(const Camera& camera, double x, double y);

/// Throws Error(usage) if the viewpoint is on or behind the hologram, if the plane in focus lies behind the viewpoint
/// for some part of the picture, or if the camera has no pixels or no pupil. The message names the wrong member.
HOGEL_API void validate(const Camera& camera);

}  // namespace hogel
