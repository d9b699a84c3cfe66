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

/// The depth at which the rays of a light end, sampled over the directions of a point light (six faces of a cube around
/// it, n × n texels each) or over a plane perpendicular to a directional light (2n × 2n texels around the scene).
///
/// A texel's ray and a point beside it meet the surface at different depths. So the stored depth is compared not with
/// the point's depth, but with the depth at which the texel's ray meets the point's tangent plane, minus three quarters
/// of a texel's width. Thus a flat surface of any slope never shadows itself, and a shadow begins at most about a texel
/// away from its caster. The four texels around a point are compared separately and the results interpolated.
class ShadowMap {
  public:
    /// @param memory  depths of an earlier map, whose memory is reused
    ShadowMap(const Light& light, const Bounds& scene, std::size_t n, std::vector<float> memory = {});

    /// The bytes of a map; 0 for a light without shadows.
    static double bytes(const Light& light, std::size_t n);

    /// The number of rows of the map. Each is filled once, in any order, by several threads.
    std::size_t rows() const { return faces_ * side_; }
    void fill(const trace::RayCaster& caster, std::size_t row);
    /// Moves the depths out.
    std::vector<float> release() { return std::move(depth_); }

    /// The share of the light that arrives at a point of a surface, 0 to 1. `normal` is perpendicular to the surface,
    /// of any length and sign.
    float visibility(Vec3 point, Vec3 normal) const;

    static constexpr double bias = 0.75;    ///< texels
    static constexpr double max_slope = 8;  ///< limit of the slope of tangent planes, in texels of depth per texel

    /// For loops over many maps: the depths [face][row][column] around a point light that casts shadows, none for
    /// others; the position of the light; and the texels along the side of a face.
    std::span<const float> faces() const {
        return point_light_ ? std::span<const float>(depth_) : std::span<const float>();
    }
    Vec3 origin() const { return origin_; }
    std::size_t side() const { return side_; }

  private:
    struct Projected {  // a point on the map
        std::size_t face;
        double column, row;  // in texels, whole numbers at texel centres
        double depth;        // along the face's axis
    };
    Projected project(Vec3 point) const;

    bool point_light_;
    std::size_t faces_, side_;
    Vec3 origin_;                // the lamp, or a corner of the plane of a directional light
    Vec3 right_, up_, forward_;  // directional: unit vectors, forward along the light
    double width_ = 0;           // directional: of a texel, metres
    double far_ = 0;             // length of the rays, beyond the whole scene
    std::vector<float> depth_;   // [face][row][column], infinity if the light meets nothing
};

/// A map for each light that casts shadows, empty for the others, in the order of scene.lights.
/// @param memory  earlier maps, whose memory is reused
std::vector<ShadowMap> make_shadow_maps(const Scene& scene, const trace::RayCaster& caster, std::size_t n,
                                        std::vector<ShadowMap> memory = {}, const Progress& progress = {});

}  // namespace hogel::shading
