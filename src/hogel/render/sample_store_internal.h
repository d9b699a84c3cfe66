#pragma once

#include <limits>

#include "hogel/lightfield/light_field.h"
#include "hogel/shading/shaded_scene.h"

namespace hogel {

/// What a ray sees first: a triangle, the weights of its vertices, the depth.
struct VisiblePoint {
    static constexpr std::size_t nothing = std::numeric_limits<std::size_t>::max();

    std::size_t triangle = nothing;
    float b0 = 0, b1 = 0, b2 = 0;
    double depth = std::numeric_limits<double>::infinity();  ///< ζ, metres
};

/// By the weights of Rec. ITU-R BT.709: what a light field with one channel holds.
inline float luminance(Rgb radiance) { return 0.2126f * radiance.r + 0.7152f * radiance.g + 0.0722f * radiance.b; }

/// Shades a visible point and stores it as sample (t, s, v, u) of a tile; t and s count from the tile's corner.
inline void store(LightFieldTile& tile, const ShadedScene& scene, const VisiblePoint& point, std::size_t t,
                  std::size_t s, std::size_t v, std::size_t u) {
    const Rgb radiance = point.triangle == VisiblePoint::nothing
                             ? scene.background
                             : radiance_at(scene, point.triangle, point.b0, point.b1, point.b2);
    if (tile.radiance.extent(0) == 3) {
        tile.radiance(0, t, s, v, u) = radiance.r;
        tile.radiance(1, t, s, v, u) = radiance.g;
        tile.radiance(2, t, s, v, u) = radiance.b;
    } else {
        tile.radiance(0, t, s, v, u) = luminance(radiance);
    }
    if (tile.depth.size() > 0) tile.depth(t, s, v, u) = static_cast<float>(point.depth);
}

}  // namespace hogel
