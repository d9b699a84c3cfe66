// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hogel/progress.h"
#include "hogel/scene.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// Depth at which the rays of a light end, sampled over the directions of a point light (six faces of a cube around it,
/// n × n texels each) or over a plane perpendicular to a directional light (2n × 2n texels around the scene).
///
/// A texel's ray and a point beside it meet the surface at different depths. So the stored depth is not compared with
/// the point's depth. It is compared with the depth at which the texel's ray meets the point's tangent plane, minus
/// three quarters of a texel's width. Thus a flat surface of any slope never shadows itself, and a shadow begins at
/// most about a texel away from its caster. The four texels around a point are compared separately and the results
/// interpolated.
class ShadowMap {
  public:
    /// @param memory  depths of an earlier map, for reusing their memory
    ShadowMap(const Light& light, const Bounds& scene, std::size_t n, std::vector<float> memory = {});

    /// Returns the size of a map in bytes; 0 for a light without shadows.
    static double bytes(const Light& light, std::size_t n);

    /// Returns the number of rows. Each row is filled once, in any order; several threads may fill different rows.
    std::size_t rows() const { return faces_ * side_; }
    void fill(const trace::RayCaster& caster, std::size_t row);
    std::vector<float> release() { return std::move(depth_); }

    /// Returns the arriving fraction of the light, 0 to 1. `normal` is perpendicular to the surface, of any length and
    /// sign.
    float visibility(Vec3 point, Vec3 normal) const;

    static constexpr double bias = 0.75;    ///< texels
    static constexpr double max_slope = 8;  ///< limit of the slope of tangent planes, in texels of depth per texel

    /// Return, for loops over many maps: the depths [face][row][column] around a point light that casts shadows (empty
    /// for other lights), the position of the light, and the number of texels along the side of a face.
    std::span<const float> faces() const {
        return point_light_ ? std::span<const float>(depth_) : std::span<const float>();
    }
    Vec3 origin() const { return origin_; }
    std::size_t side() const { return side_; }

  private:
    struct Projected {  // point on the map
        std::size_t face;
        double column, row;  // in texels, integer at texel centres
        double depth;        // along the face's axis
    };
    Projected project(Vec3 point) const;

    bool point_light_;
    std::size_t faces_, side_;
    Vec3 origin_;                // the lamp, or a corner of the plane of a directional light
    Vec3 right_, up_, forward_;  // directional: unit vectors, forward along the light
    double width_ = 0;           // directional: width of a texel in metres
    double far_ = 0;             // length of the rays in metres, beyond the whole scene
    std::vector<float> depth_;   // [face][row][column], infinity if the light meets nothing
};

/// Returns a map for each light that casts shadows, empty for the others, in the order of scene.lights.
/// @param memory  earlier maps, for reusing their memory
std::vector<ShadowMap> make_shadow_maps(const Scene& scene, const trace::RayCaster& caster, std::size_t n,
                                        std::vector<ShadowMap> memory = {}, const Progress& progress = {});

}  // namespace hogel::shading
