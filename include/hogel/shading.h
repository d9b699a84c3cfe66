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

/// A shading model, which decides where and how the light on surfaces is evaluated. Source: [K] 5.8.
struct ShadingInfo {
    std::string name;  ///< of ShadingOptions::model
    std::string text;  ///< one line
    /// Computes the light of a scene. `shaded` has the scene's geometry, its textures and the given radiance of meshes;
    /// the radiance of all other vertices is zero. The function either sets the latter and returns null, or returns an
    /// object that evaluates light at samples. `shaded.lighting` is the result of the last call, whose memory may be
    /// reused.
    std::function<std::shared_ptr<const SampleLighting>(const Scene& scene, const ShadingOptions& options,
                                                        ShadedScene& shaded, const Progress& progress)>
        make;
    /// Bytes that the shadow maps of a scene take; null where the model has none.
    std::function<double(const Scene& scene, const ShadingOptions& options)> shadow_map_bytes = nullptr;
};

/// The shading models by name:
///   auto      direct for large triangles (Scene::has_large_triangles) or maps of gloss or relief, otherwise vertex
///   vertex    at the vertices, with shadow rays, and interpolated; matt. Radiance = emission + colour · (ambient + Σ E
///             · max(0, n·l)/π) over the lights that the vertex sees, E = intensity for a directional light and
///             intensity/r² for a point light. Cost: vertices × lights rays
///   direct    at each sample, with shadow maps, and the glossy lobe
///   shadowed  at the vertices without shadows, interpolated, and combined with shadow maps at each sample; matt
///   given     none: the radiance of each vertex is given by the scene
HOGEL_API Table<ShadingInfo>& shading_models();

/// How shade_scene() evaluates light.
struct ShadingOptions {
    std::string model = "auto";     ///< a name of shading_models()
    std::size_t shadow_map = 512;   ///< texels along a side of a shadow map (twice that across a directional light)
    double max_shadow_bytes = 8e9;  ///< of all shadow maps together
    bool filter_textures = true;    ///< whether textures are averaged over the area that a sample covers
};

/// The name of the model that lights a scene: options.model or, where that is `auto`, the one that it stands for. That
/// is `vertex` too where the shadow maps of `direct` would be larger than allowed.
HOGEL_API std::string shading_model(const Scene& scene, const ShadingOptions& options = {});

/// Bytes that the shadow maps of a scene take: 0 where the model has none. Throws Error(usage) for an unknown model.
HOGEL_API double shadow_map_bytes(const Scene& scene, const ShadingOptions& options);

/// Makes a scene ready to be rendered. Meshes with given radiance show it in every model. Throws what validate(Scene)
/// throws; Error(bad_input) for a mesh without normals in a scene with lights and, in the model `given`, for a mesh
/// without radiance; Error(usage) for an unknown model and for shadow maps larger than allowed.
HOGEL_API ShadedScene shade_scene(const Scene& scene, const ShadingOptions& options = {},
                                  const Progress& progress = {});

/// As shade_scene(), but reuses the memory of `shaded`, so that a scene that has changed but not grown allocates
/// little. A texture behind the same pointer as before is taken as unchanged. `shaded.fronts_only` keeps its value; the
/// radiance cache is dropped. After an exception `shaded` may only be destroyed, assigned or shaded again.
HOGEL_API void shade_scene_into(const Scene& scene, const ShadingOptions& options, ShadedScene& shaded,
                                const Progress& progress = {});

/// Shades a scene with the model `vertex` and textures that are not filtered. Shadow rays start above the surface, at a
/// ten-thousandth of the scene's diagonal.
HOGEL_API ShadedScene shade_scene_vertices(const Scene& scene);

/// A picture on a surface, repeated in both directions unless its sampling says otherwise, with optional coarser levels
/// for distant views.
class HOGEL_API Texture {
  public:
    /// If `filtered`, makes coarser levels, each half the size and the mean of the one before, down to a single texel
    /// (a third more memory). Otherwise sample() interpolates the finest level alone.
    Texture(std::shared_ptr<const Image> finest, bool filtered = false, const TextureSampling& sampling = {});

    /// The picture interpolated between texels, averaged over about `width` texels of the finest level.
    Rgb sample(TextureCoordinate at, double width) const;
    /// The same of the picture's fourth channel, alpha; 1 for a picture without one.
    float alpha(TextureCoordinate at, double width) const;
    /// Number of texels of the finest level, which covers the unit square of texture coordinates.
    double texels() const { return static_cast<double>(finest_->width()) * static_cast<double>(finest_->height()); }
    /// Whether there are coarser levels; never for a picture of one texel.
    bool filtered() const { return !coarser_.empty(); }
    /// The finest level.
    const std::shared_ptr<const Image>& picture() const { return finest_; }
    const TextureSampling& sampling() const { return sampling_; }

  private:
    template <class Value, class Interpolate>
    Value between_levels(double width, const Interpolate& interpolate) const;

    TextureSampling sampling_;
    std::shared_ptr<const Image> finest_;
    std::vector<Image> coarser_;
};

/// The view of a surface by one sample.
struct ViewSample {
    Vec3 to_viewer{0, 0, 1};  ///< unit length
    double footprint = 0;     ///< width of the sample on the surface, metres, over which textures are averaged
};

/// Lighting that is evaluated for each sample: a pure function of the point that a ray hits and the direction to the
/// viewer, so that samples do not depend on the order or the tile in which they are read. There are two steps:
/// light_on() evaluates the light that falls on a point, which is costly and the same for all rays that see the point;
/// radiance() evaluates what one ray sees of it.
class HOGEL_API SampleLighting {
  public:
    /// How many numbers describe the light on a point.
    struct Size {
        std::size_t values = 0;  ///< non-negative numbers of any size, which come first
        std::size_t shares = 0;  ///< numbers between 0 and 1
        /// Length of the list of numbers.
        std::size_t sum() const { return values + shares; }
    };

    virtual ~SampleLighting() = default;
    /// How many numbers describe the light on a mesh; none if its light is completely given by the radiance of its
    /// vertices.
    virtual Size size_of_light(std::size_t mesh) const = 0;
    /// Whether the light is three numbers, the radiance before the texture, the same for all viewers.
    virtual bool light_is_radiance(std::size_t mesh) const = 0;
    /// Evaluates the light on the point of triangle `index` that has these weights of its vertices. `light` has
    /// size_of_light().sum() elements, which may be interpolated between points of one triangle.
    virtual void light_on(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                          std::span<float> light) const = 0;
    /// The radiance towards the viewer of that point under that light. Called only for meshes whose size_of_light() is
    /// not zero. `texture` multiplies the base colour and the emission.
    virtual Rgb radiance(const ShadedScene& /*scene*/, std::size_t /*index*/, const std::array<float, 3>& /*weights*/,
                         std::span<const float> light, Rgb texture, const ViewSample& /*view*/) const {
        return texture * Rgb{light[0], light[1], light[2]};
    }
};

/// A scene ready for any renderer: one list of triangles, with their light. Without `lighting` the radiance at a point
/// of a triangle is the interpolated vertex radiance times the texture. Renderers share a scene through a pointer to
/// const.
struct ShadedScene {
    /// Triangle::texture of a triangle without texture.
    static constexpr std::uint32_t no_texture = std::numeric_limits<std::uint32_t>::max();

    /// A triangle of any mesh.
    struct Triangle {
        std::array<std::uint32_t, 3> vertices;  ///< indices into `positions`, counterclockwise from its front
        std::uint32_t texture = no_texture;     ///< index into `textures`
        std::uint32_t mesh = 0;                 ///< index of the mesh that it came from
    };

    std::vector<Vec3> positions;  ///< metres, world frame
    std::vector<Rgb> radiance;    ///< at the vertices, before the texture: reflected light plus emission
    std::vector<TextureCoordinate> texture_coordinates;  ///< as long as `positions`
    /// Triangles of all meshes, in the scene's order. Among those with the same corners shade_scene_into() keeps one,
    /// the first whose front faces the middle of the hologram or else the first; one of each winding if `fronts_only`.
    /// Otherwise it turns those of double-sided materials whose back is seen from there.
    std::vector<Triangle> triangles;
    std::vector<Texture> textures;  ///< each picture of the scene once
    /// The triangles that are not everywhere opaque, with all of the scene's vertices, textures and lighting; null if
    /// there are none. `triangles` are the others. make_renderer() draws both.
    std::shared_ptr<const ShadedScene> layers;
    /// In a scene of layers, alpha at the vertices, before the texture, and what it means for each mesh.
    std::vector<float> alphas;
    struct MeshAlpha {
        AlphaMode mode = AlphaMode::opaque;
        float cutoff = 0;
    };
    std::vector<MeshAlpha> mesh_alphas;
    Rgb background;  ///< radiance of rays that meet nothing
    /// Whether triangles are visible only from their front, from where their corners run counterclockwise. Light falls
    /// on both sides, and both sides cast shadows. To be set before the scene is shaded.
    bool fronts_only = false;
    std::shared_ptr<const SampleLighting> lighting;          ///< null if `radiance` gives all light
    std::shared_ptr<shading::RadianceCache> radiance_cache;  ///< null: light is evaluated anew for each ray
    /// Where it comes from: the name of the scene, and the shading model unless all radiance was given.
    Metadata provenance;

    /// Whether a triangle of this mesh may let rays through.
    bool is_layer(std::uint32_t mesh) const {
        return !mesh_alphas.empty() && mesh_alphas[mesh].mode != AlphaMode::opaque;
    }
    /// Whether light is evaluated at the samples of this triangle instead of at its vertices.
    bool is_lit(std::size_t index) const {
        return lighting && lighting->size_of_light(triangles[index].mesh).sum() > 0;
    }
    /// Whether the radiance of this triangle is more than an interpolation between its vertices.
    bool needs_samples(std::size_t index) const { return triangles[index].texture != no_texture || is_lit(index); }
};

/// The radiance at the point of triangle `index` with barycentric weights b0, b1, b2 (of its three vertices).
HOGEL_API Rgb radiance_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2,
                          const ViewSample& view = {});

/// The share of a ray that the point of triangle `index` with these barycentric weights keeps from what is behind it:
/// alpha where the surface blends, 0 or 1 where it has a mask, 1 where it is opaque. Masks are not averaged over what a
/// sample covers: whether a surface is there depends on the point alone.
HOGEL_API float opacity_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2,
                           const ViewSample& view = {});

/// Accuracy of bake_scene().
struct BakeOptions {
    std::size_t rays = 256;        ///< rays from each vertex that gather the light reflected by other surfaces
    std::size_t bounces = 5;       ///< number of reflections between surfaces
    std::size_t tessellation = 1;  ///< each triangle is cut into tessellation² triangles
    std::uint64_t seed = 1;        ///< of the random directions of rays
};

/// Computes global illumination: returns the scene with the radiance of every vertex given, including the light that
/// surfaces reflect onto each other. Surfaces are matt. Rays that leave the scene meet its ambient light, which
/// therefore casts shadows. The backs of surfaces are black, since closed bodies never show them.
///
/// Radiosity by gathering (B = B_0 + ρ ∫ B cos θ/π dω solved by iteration): in each of `bounces` rounds every vertex
/// sends rays with a density proportional to the cosine, and collects the radiance of the round before, interpolated
/// between the vertices around each hit. All rounds but the last send an eighth of the rays. Indirect light varies
/// slowly over a surface, so it is computed before the triangles are cut; direct light is computed after.
///
/// The result is the same for any number of threads, to the byte. Cost: vertices × rays × (1 + bounces/8) rays, and one
/// shadow ray per light for each vertex of the cut triangles. Throws what shade_scene() throws, and Error(usage) for
/// zero rays or a tessellation of zero.
HOGEL_API Scene bake_scene(const Scene& scene, const BakeOptions& options = {}, const Progress& progress = {});

/// Resources to light a scene for good and write it as a mesh.
HOGEL_API Plan plan_bake(const Scene& scene, const BakeOptions& options = {});

}  // namespace hogel
