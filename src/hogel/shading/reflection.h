// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene.h"

namespace hogel::shading {

/// The light on a point that is available for diffuse reflection to any viewer: Σ E n·l/π minus the part of the
/// incident light that the lobe reflects. Since the lobe's albedo is linear in its reflectance, it is arriving −
/// reflectance · for_lobe.
struct LightUnderLobe {
    Rgb arriving{0, 0, 0}, for_lobe{0, 0, 0};

    /// Adds a light of this irradiance at normal incidence; n·l is cos_light > 0.
    void add(const Material& material, Rgb irradiance, double cos_light);
};

/// The radiance reflected by a lobe: its reflectance at normal incidence times `scale`, plus `offset`.
struct LightInLobe {
    Rgb scale{0, 0, 0}, offset{0, 0, 0};
};

/// The albedo of a lobe whose reflectance at normal incidence is r: r · scale + offset. Both are read from a table over
/// cosine and roughness with an error below 0.5 %.
struct LobeAlbedo {
    double scale, offset;
};
LobeAlbedo lobe_albedo(double cosine, double roughness);

/// The mean of the albedo over the hemisphere, weighted by the cosine.
LobeAlbedo mean_lobe_albedo(double roughness);

/// The reflection at a point of a surface: a diffuse part and a glossy lobe (GGX microfacets) that together reflect no
/// more than they receive, and reciprocally.
///
/// The lobe is D V F: the distribution of Trowbridge and Reitz, the masking and shadowing of Smith for correlated
/// heights and Schlick's reflectance (Walter et al., "Microfacet models for refraction", 2007; Heitz, "Understanding
/// the masking-shadowing function", 2014). The diffuse part has the incident and reflected light that the lobe leaves:
///     color/π · (1 − E(n·l)) (1 − E(n·v)) / (1 − mean of E),
/// where E is the lobe's albedo (Kelemen and Szirmay-Kalos, 2001). In uniform light a white surface has the radiance of
/// that light.
class Reflection {
  public:
    /// @param color     of the diffuse part and, in proportion to Material::metallic, of the lobe
    /// @param cos_view  n·v; the diffuse part looks the same from behind (n·v < 0), the lobe is visible only from the
    ///                  front
    Reflection(const Material& material, Rgb color, double cos_view);

    /// The two parts: the lobe, for one direction or for a sum of lights, and the diffuse part, for any sum of lights.
    Rgb lobe(Vec3 normal, Vec3 to_viewer, Vec3 to_light, double cos_light) const;
    Rgb lobe(const LightInLobe& light) const { return light.scale * lobe_ + light.offset; }
    Rgb diffuse(const LightUnderLobe& light) const;
    /// The radiance towards the viewer for irradiance 1 at normal incidence from the unit direction l: the distribution
    /// function times n·l. n is the unit normal, v the unit direction to the viewer.
    Rgb towards(Vec3 normal, Vec3 to_viewer, Vec3 to_light, double cos_light) const;
    /// The radiance towards the viewer in uniform light of radiance 1.
    Rgb in_uniform_light() const;
    /// The roughness of the lobe, at least min_roughness.
    double roughness() const { return roughness_; }

  private:
    bool glossy_ = false;
    Rgb diffuse_, lobe_;   // lobe_: its reflectance at normal incidence
    double max_lobe_ = 0;  // the largest channel of that, for E
    double roughness_ = 1, cos_view_ = 1;
    LobeAlbedo here_{0, 0};    // E(n·v)
    double left_by_lobe_ = 1;  // (1 − E(n·v)) / (1 − mean of E)
};

/// The minimum roughness; smoother surfaces are treated as this rough, because the mirror image of a point light would
/// be a point.
inline constexpr double min_roughness = 0.15;

}  // namespace hogel::shading
