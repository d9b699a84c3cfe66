// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene.h"

namespace hogel::shading {

/// Light at a point that is available for diffuse reflection to any viewer: Σ E n·l/π minus the part that the lobe
/// reflects. The lobe's albedo is linear in its reflectance, so this is arriving − reflectance · for_lobe.
struct LightUnderLobe {
    Rgb arriving{0, 0, 0}, for_lobe{0, 0, 0};

    /// Adds a light with this irradiance at normal incidence; n·l is cos_light > 0.
    void add(const Material& material, Rgb irradiance, double cos_light);
};

/// Radiance reflected by a lobe: its reflectance at normal incidence times `scale`, plus `offset`.
struct LightInLobe {
    Rgb scale{0, 0, 0}, offset{0, 0, 0};
};

/// Albedo of a lobe with reflectance r at normal incidence: r · scale + offset. Both are read from a table over cosine
/// and roughness with an error below 0.5 %.
struct LobeAlbedo {
    double scale, offset;
};
LobeAlbedo lobe_albedo(double cosine, double roughness);

/// Returns the mean of the albedo over the hemisphere, weighted by the cosine.
LobeAlbedo mean_lobe_albedo(double roughness);

/// Reflection at a point of a surface: a diffuse part and a glossy lobe (GGX microfacets). Together they reflect no
/// more light than arrives, and they are reciprocal.
///
/// The lobe is D V F: the distribution of Trowbridge and Reitz, the masking and shadowing of Smith for correlated
/// heights and Schlick's reflectance (Walter et al., "Microfacet models for refraction", 2007; Heitz, "Understanding
/// the masking-shadowing function", 2014). The diffuse part has the incident and reflected light that the lobe does not
/// reflect:
///     color/π · (1 − E(n·l)) (1 − E(n·v)) / (1 − mean of E),
/// where E is the lobe's albedo (Kelemen and Szirmay-Kalos, 2001). In uniform light a white surface has the radiance of
/// that light.
class Reflection {
  public:
    /// @param color     of the diffuse part and, in proportion to Material::metallic, of the lobe
    /// @param cos_view  n·v; the lobe is visible only from the front (n·v > 0), the diffuse part from both sides
    Reflection(const Material& material, Rgb color, double cos_view);

    /// Return the lobe, for one direction or a sum of lights, and the diffuse part, for any sum of lights.
    Rgb lobe(Vec3 normal, Vec3 to_viewer, Vec3 to_light, double cos_light) const;
    Rgb lobe(const LightInLobe& light) const { return light.scale * lobe_ + light.offset; }
    Rgb diffuse(const LightUnderLobe& light) const;
    /// Returns the radiance towards the viewer for irradiance 1 at normal incidence from the unit direction l: the
    /// distribution function times n·l. n is the unit normal, v the unit direction to the viewer.
    Rgb towards(Vec3 normal, Vec3 to_viewer, Vec3 to_light, double cos_light) const;
    /// Returns the radiance towards the viewer in uniform light of radiance 1.
    Rgb in_uniform_light() const;
    double roughness() const { return roughness_; }

  private:
    bool glossy_ = false;
    Rgb diffuse_, lobe_;   // lobe_: reflectance of the lobe at normal incidence
    double max_lobe_ = 0;  // largest channel of lobe_, for E
    double roughness_ = 1, cos_view_ = 1;
    LobeAlbedo albedo_{0, 0};   // E(n·v)
    double diffuse_scale_ = 1;  // (1 − E(n·v)) / (1 − mean of E)
};

/// Minimum roughness: the mirror image of a point light in a smoother surface would be a point.
inline constexpr double min_roughness = 0.15;

}  // namespace hogel::shading
