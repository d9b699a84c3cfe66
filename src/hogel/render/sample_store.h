// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::render {

/// Visible point of a ray: triangle, weights of its vertices, and depth.
struct VisiblePoint {
    static constexpr std::size_t nothing = std::numeric_limits<std::size_t>::max();

    std::size_t triangle = nothing;
    float b0 = 0, b1 = 0, b2 = 0;
    double depth = std::numeric_limits<double>::infinity();  ///< ζ, metres
};

/// Returns the value of a light field with one channel: luminance by Rec. ITU-R BT.709.
inline float luminance(Rgb radiance) { return 0.2126f * radiance.r + 0.7152f * radiance.g + 0.0722f * radiance.b; }

/// Returns the ViewSample of the ray (U, V) of a grid at a surface at depth ζ. On the surface, rays of neighbouring
/// hogels are a pitch apart, and neighbouring rays of one hogel ζΔU; a sample covers the larger of the two.
inline ViewSample view_sample(const LightFieldGrid& grid, double U, double V, double depth) {
    const Vec3 direction = grid.direction_of(U, V);
    const double spread = std::abs(depth / direction.z) * std::max(grid.step_u(), grid.step_v());
    return {normalize({-direction.x, -direction.y, direction.z}), std::max(grid.pitch, spread)};
}

/// Stores a sample (t, s, v, u) of a tile; t and s are relative to the tile's corner.
inline void store(LightFieldTile& tile, Rgb radiance, double depth, std::size_t t, std::size_t s, std::size_t v,
                  std::size_t u) {
    if (tile.radiance.extent(0) == 3) {
        tile.radiance(0, t, s, v, u) = radiance.r;
        tile.radiance(1, t, s, v, u) = radiance.g;
        tile.radiance(2, t, s, v, u) = radiance.b;
    } else {
        tile.radiance(0, t, s, v, u) = luminance(radiance);
    }
    if (tile.depth.size() > 0) tile.depth(t, s, v, u) = static_cast<float>(depth);
}

/// Shades a visible point and stores it as sample (t, s, v, u) of a tile.
inline void store(LightFieldTile& tile, const ShadedScene& scene, const LightFieldGrid& grid, const VisiblePoint& point,
                  std::size_t t, std::size_t s, std::size_t v, std::size_t u) {
    Rgb radiance = scene.background;
    if (point.triangle != VisiblePoint::nothing) {
        ViewSample view;
        if (scene.needs_samples(point.triangle))
            view = view_sample(grid, grid.u(static_cast<double>(u)), grid.v(static_cast<double>(v)), point.depth);
        radiance = radiance_at(scene, point.triangle, point.b0, point.b1, point.b2, view);
    }
    store(tile, radiance, point.depth, t, s, v, u);
}

}  // namespace hogel::render
