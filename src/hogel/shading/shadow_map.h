// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/progress.h"
#include "hogel/scene.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// How far the light of a lamp reaches, sampled over the directions (point light: the six faces of a cube around it, n
/// × n texels each) or over a plane across its direction (directional light: 2n × 2n texels around the scene).
///
/// A texel's ray and a point beside it meet the surface at different depths. So a point's depth is not compared, but
/// that of its tangent plane where the texel's ray meets it, less three quarters of a texel's width: on a flat surface
/// a texel never shadows itself, however slanted, and a shadow begins at most about a texel beside its caster. The four
/// texels around a point are compared each and their answers interpolated.
class ShadowMap {
  public:
    ShadowMap(const Light& light, const Bounds& scene, std::size_t n);

    /// The memory that it takes.
    static double bytes(const Light& light, std::size_t n);

    /// The map is filled row by row, each once, in any order and by several threads.
    std::size_t rows() const { return faces_ * side_; }
    void fill(const trace::RayCaster& caster, std::size_t row);

    /// How much of the light arrives at a point of a surface: 0 to 1. `normal` is perpendicular to the surface, of any
    /// length and sign.
    float lit(Vec3 point, Vec3 normal) const;

    static constexpr double bias = 0.75;   ///< texels
    static constexpr double steepest = 8;  ///< how many texels of depth a tangent plane may fall away over one texel

    /// For loops that look into many maps: the depths [face][row][column] around a point light that casts shadows, none
    /// for others; where it is; and how many texels lie along the side of a face.
    std::span<const float> faces() const {
        return point_light_ ? std::span<const float>(depth_) : std::span<const float>();
    }
    Vec3 origin() const { return origin_; }
    std::size_t side() const { return side_; }

  private:
    struct Place {  // of a point, or of a texel's ray, on the map
        std::size_t face;
        double column, row;  // in texels, whole numbers at their middles
        double depth;        // along the face's axis
    };
    Place place(Vec3 point) const;

    bool point_light_;
    std::size_t faces_, side_;
    Vec3 origin_;                // the lamp, or a corner of the plane of a directional light
    Vec3 right_, up_, forward_;  // directional: unit vectors, forward along the light
    double width_ = 0;           // directional: of a texel, metres
    double far_ = 0;             // no depth of interest is larger
    std::vector<float> depth_;   // [face][row][column], infinity where the light meets nothing
};

/// A map for each light that casts shadows, empty for the others, in the order of scene.lights.
std::vector<ShadowMap> make_shadow_maps(const Scene& scene, const trace::RayCaster& caster, std::size_t n,
                                        const Progress& progress = {});

}  // namespace hogel::shading
