// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hogel/export.h"
#include "hogel/progress.h"
#include "hogel/provenance.h"
#include "hogel/resources.h"
#include "hogel/scene.h"
#include "hogel/table.h"

namespace hogel {

struct ShadedScene;
struct ShadingOptions;
class SampleLighting;
namespace shading {
class RadianceCache;
}

/// A shading model: where and how light on surfaces is evaluated. Source: [K] 5.8.
struct ShadingInfo {
    std::string name;  ///< for ShadingOptions::model
    std::string text;  ///< one line
    /// Computes the light of a scene. `shaded` has the scene's geometry, textures and given radiance; the radiance of
    /// all other vertices is zero. The function either sets that radiance and returns null, or returns an object that
    /// evaluates light at samples. `shaded.lighting` is the result of the last call; its memory may be reused.
    std::function<std::shared_ptr<const SampleLighting>(const Scene& scene, const ShadingOptions& options,
                                                        ShadedScene& shaded, const Progress& progress)>
        make;
    /// Returns the size of a scene's shadow maps, bytes. Null: the model has none.
    std::function<double(const Scene& scene, const ShadingOptions& options)> shadow_map_bytes = nullptr;
};

/// Returns the shading models by name:
///   auto      `direct` for large triangles (Scene::has_large_triangles) or gloss or relief maps, otherwise `vertex`
///   vertex    at the vertices, with shadow rays, and interpolated; diffuse only.
///             Radiance = emission + colour · (ambient + Σ E · max(0, n·l)/π) over the lights visible from the vertex;
///             E = intensity for a directional light, intensity/r² for a point light. Cost: vertices × lights rays
///   direct    at each sample, with shadow maps and the glossy lobe
///   shadowed  at the vertices without shadows, interpolated, with shadow maps at each sample; diffuse only
///   given     none: the scene has the radiance of each vertex
HOGEL_API Table<ShadingInfo>& shading_models();

/// Options of shade_scene().
struct ShadingOptions {
    std::string model = "auto";     ///< name of a row of shading_models()
    std::size_t shadow_map = 512;   ///< texels along a side of a shadow map; twice that for a directional light
    double max_shadow_bytes = 8e9;  ///< of all shadow maps
    bool filter_textures = true;    ///< whether textures are averaged over the footprint of a sample
};

/// Returns the name of the model used for a scene: options.model, or the one that `auto` selects. `auto` also selects
/// `vertex` if the shadow maps of `direct` would exceed max_shadow_bytes.
HOGEL_API std::string shading_model(const Scene& scene, const ShadingOptions& options = {});

/// Returns the size of a scene's shadow maps, bytes; 0 if the model has none. Throws Error(usage) for an unknown model.
HOGEL_API double shadow_map_bytes(const Scene& scene, const ShadingOptions& options);

/// Prepares a scene for rendering. Meshes with given radiance show it in every model. Throws as validate(Scene) does;
/// Error(bad_input) for a mesh without normals in a scene with lights and, in the model `given`, for a mesh without
/// radiance; Error(usage) for an unknown model, and for shadow maps above max_shadow_bytes.
HOGEL_API ShadedScene shade_scene(const Scene& scene, const ShadingOptions& options = {},
                                  const Progress& progress = {});

/// Prepares a scene as shade_scene() does, and reuses the memory of `shaded`. A changed scene of the same size
/// allocates little. A texture behind the same pointer counts as unchanged. `shaded.fronts_only` keeps its value; the
/// radiance cache is dropped. After an exception `shaded` can only be destroyed, assigned or shaded again.
HOGEL_API void shade_scene_into(const Scene& scene, const ShadingOptions& options, ShadedScene& shaded,
                                const Progress& progress = {});

/// Shades a scene with the model `vertex`, unfiltered textures, and shadow rays from 10⁻⁴ of its diagonal above
/// surfaces.
HOGEL_API ShadedScene shade_scene_vertices(const Scene& scene);

/// A picture on a surface, repeated in both directions unless its sampling says otherwise. Coarser mipmap levels are
/// optional.
class HOGEL_API Texture {
  public:
    /// If `filtered`, makes coarser levels down to a single texel, each half the size and the mean of the one before.
    /// They take a third more memory. Otherwise sample() interpolates only the finest level.
    Texture(std::shared_ptr<const Image> finest, bool filtered = false, const TextureSampling& sampling = {});

    /// Returns the picture interpolated between texels, averaged over about `width` texels of the finest level.
    Rgb sample(TextureCoordinate at, double width) const;
    /// Returns the picture's fourth channel, alpha, in the same way; 1 for a picture without alpha.
    float alpha(TextureCoordinate at, double width) const;
    /// Returns the number of texels of the finest level, which covers the unit square of texture coordinates.
    double texels() const { return static_cast<double>(finest_->width()) * static_cast<double>(finest_->height()); }
    /// Returns whether there are coarser levels; false for a picture of one texel.
    bool filtered() const { return !coarser_.empty(); }
    /// Returns the finest level.
    const std::shared_ptr<const Image>& picture() const { return finest_; }
    const TextureSampling& sampling() const { return sampling_; }

  private:
    template <class Value, class Interpolate>
    Value between_levels(double width, const Interpolate& interpolate) const;

    TextureSampling sampling_;
    std::shared_ptr<const Image> finest_;
    std::vector<Image> coarser_;
};

/// View of a surface point by one sample.
struct ViewSample {
    Vec3 to_viewer{0, 0, 1};  ///< unit length
    double footprint = 0;     ///< width of the sample on the surface, metres; textures are averaged over it
};

/// Lighting that is evaluated for each sample. It is a pure function of the hit point and the direction to the viewer,
/// so samples do not depend on reading order or tiles. light_on() evaluates the light that falls on a point: costly,
/// and the same for all rays that see the point. radiance() evaluates the reflection towards one ray.
class HOGEL_API SampleLighting {
  public:
    /// The number of values that describe the light on a point.
    struct Size {
        std::size_t values = 0;  ///< non-negative numbers of any size; first in the list
        std::size_t shares = 0;  ///< numbers between 0 and 1
        /// Returns the length of the list.
        std::size_t sum() const { return values + shares; }
    };

    virtual ~SampleLighting() = default;
    /// Returns the number of values for a mesh; none if the radiance of its vertices defines all its light.
    virtual Size size_of_light(std::size_t mesh) const = 0;
    /// Returns whether the light is three numbers: the radiance before the texture, the same for all viewers.
    virtual bool light_is_radiance(std::size_t mesh) const = 0;
    /// Evaluates the light on a point of triangle `index` with these barycentric weights.
    /// @param light  receives size_of_light().sum() values, which can be interpolated between points of one triangle
    virtual void light_on(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                          std::span<float> light) const = 0;
    /// Returns the radiance of that point towards the viewer under that light. Called only for meshes with a nonzero
    /// size_of_light(). `texture` multiplies base colour and emission.
    virtual Rgb radiance(const ShadedScene& /*scene*/, std::size_t /*index*/, const std::array<float, 3>& /*weights*/,
                         std::span<const float> light, Rgb texture, const ViewSample& /*view*/) const {
        return texture * Rgb{light[0], light[1], light[2]};
    }
};

/// A scene ready for all renderers: one list of triangles with their light. Without `lighting` the radiance of a point
/// is the interpolated vertex radiance times the texture. Renderers share a scene through a pointer to const.
struct ShadedScene {
    /// Triangle::texture of a triangle without texture.
    static constexpr std::uint32_t no_texture = std::numeric_limits<std::uint32_t>::max();

    /// A triangle of any mesh.
    struct Triangle {
        std::array<std::uint32_t, 3> vertices;  ///< indices into `positions`, counterclockwise seen from the front
        std::uint32_t texture = no_texture;     ///< index into `textures`
        std::uint32_t mesh = 0;                 ///< index of its mesh
    };

    std::vector<Vec3> positions;  ///< metres, world frame
    std::vector<Rgb> radiance;    ///< at the vertices, before the texture: reflected light plus emission
    std::vector<TextureCoordinate> texture_coordinates;  ///< as long as `positions`
    /// Triangles of all meshes, in the scene's order. Of triangles with the same corners, shade_scene_into() keeps the
    /// first with its front towards the centre of the hologram, else the first. If `fronts_only`, it keeps one of each
    /// winding; otherwise it flips triangles of double-sided materials with their back towards that point.
    std::vector<Triangle> triangles;
    std::vector<Texture> textures;  ///< each picture of the scene once
    /// The triangles that are not fully opaque, with all vertices, textures and lighting of the scene; null if there
    /// are none. `triangles` has the other ones. make_renderer() draws both.
    std::shared_ptr<const ShadedScene> layers;
    /// In a scene of layers: alpha at the vertices, before the texture, and its mode for each mesh.
    std::vector<float> alphas;
    struct MeshAlpha {
        AlphaMode mode = AlphaMode::opaque;
        float cutoff = 0;
    };
    std::vector<MeshAlpha> mesh_alphas;
    Rgb background;  ///< radiance of rays that meet nothing
    /// Whether triangles are visible only from their front (corners counterclockwise). Light still falls on both sides,
    /// and both sides cast shadows. Set it before shading the scene.
    bool fronts_only = false;
    std::shared_ptr<const SampleLighting> lighting;          ///< null if `radiance` contains all light
    std::shared_ptr<shading::RadianceCache> radiance_cache;  ///< null: light is evaluated for each ray
    /// Origin: name of the scene, and the shading model unless all radiance was given.
    Metadata provenance;

    /// Returns whether triangles of a mesh can be transparent.
    bool is_layer(std::uint32_t mesh) const {
        return !mesh_alphas.empty() && mesh_alphas[mesh].mode != AlphaMode::opaque;
    }
    /// Returns whether light is evaluated at the samples of a triangle instead of at its vertices.
    bool is_lit(std::size_t index) const {
        return lighting && lighting->size_of_light(triangles[index].mesh).sum() > 0;
    }
    /// Returns whether the radiance of a triangle is more than an interpolation between its vertices.
    bool needs_samples(std::size_t index) const { return triangles[index].texture != no_texture || is_lit(index); }
};

/// Returns the radiance at a point of triangle `index` with barycentric weights b0, b1, b2.
HOGEL_API Rgb radiance_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2,
                          const ViewSample& view = {});

/// Returns the opacity at a point of triangle `index` with these barycentric weights: alpha for a blended surface, 0 or
/// 1 for a mask, 1 for an opaque surface. Masks are not averaged over the footprint of a sample.
HOGEL_API float opacity_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2,
                           const ViewSample& view = {});

/// Options of bake_scene().
struct BakeOptions {
    std::size_t rays = 256;        ///< rays per vertex that gather light from other surfaces
    std::size_t bounces = 5;       ///< number of reflections between surfaces
    std::size_t tessellation = 1;  ///< each triangle is divided into tessellation² triangles
    std::uint64_t seed = 1;        ///< of the random directions of rays
};

/// Computes global illumination. Returns the scene with given radiance at every vertex, including light reflected
/// between surfaces. Surfaces are diffuse. Rays that leave the scene meet its ambient light, which therefore casts
/// shadows. The backs of surfaces are black, because closed bodies never show them.
///
/// Radiosity by gathering, which solves B = B_0 + ρ ∫ B cos θ/π dω by iteration. In each of `bounces` rounds every
/// vertex sends cosine-distributed rays, and collects the radiance of the previous round, interpolated between the
/// vertices around each hit. All rounds but the last send an eighth of the rays. Indirect light varies slowly over a
/// surface, so it is computed before the triangles are divided; direct light is computed after.
///
/// The result has the same bytes for any number of threads. Cost: vertices × rays × (1 + bounces/8) rays, and one
/// shadow ray per light and vertex of the divided triangles. Throws as shade_scene() does, and Error(usage) for zero
/// rays or tessellation.
HOGEL_API Scene bake_scene(const Scene& scene, const BakeOptions& options = {}, const Progress& progress = {});

/// Estimates the resources to bake a scene and write it as a mesh.
HOGEL_API Plan plan_bake(const Scene& scene, const BakeOptions& options = {});

}  // namespace hogel
