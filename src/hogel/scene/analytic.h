// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hogel/geometry.h"

namespace hogel::scene {

/// A ray of the light field given by a closed form.
struct AnalyticSample {
    Rgb radiance;
    double depth = 0;      ///< ζ, metres; +infinity if the ray meets nothing
    double clearance = 0;  ///< distance of the ray from the nearest silhouette, metres
};

/// Returns whether a built-in scene has a closed-form light field: plane, two-planes, sphere, point.
bool has_analytic_radiance(std::string_view name);

/// Returns the closed form of a built-in scene of size D, independent of its mesh, as a reference for renderers. The
/// ray crosses the hologram at (s, t) and passes x = s + Uζ, y = t + Vζ. A correct renderer agrees if the clearance
/// exceeds D/1000: radiance to 1e-3, depth to 1e-3 D (plane, two-planes and point: to rounding). Throws Error(usage)
/// for a scene without closed form.
///   plane       a picture of half-width 0.425 D at ζ = 0.2 D
///   two-planes  the same picture behind one of half-width 0.15 D at ζ = −0.1 D, centred at (−0.05 D, 0.04 D)
///   sphere      of radius 0.3 D around the hologram's centre, diffuse, one directional light and ambient light
///   point       a disc of radius 0.005 D and radiance 1 at (0.1 D, 0.05 D), ζ = 0.15 D
AnalyticSample analytic_radiance(std::string_view name, double hologram_size, double s, double t, double U, double V);

}  // namespace hogel::scene
