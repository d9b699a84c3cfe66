// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "hogel/progress.h"
#include "hogel/scene.h"

namespace hogel {

struct ShadedScene;
namespace shading {
class LightCache;
}

/// Where light is worked out. The models of [K] 5.8.
enum class ShadingModel {
    vertex,    ///< at the vertices, with shadow rays, and interpolated; matt
    direct,    ///< at each sample, with shadow maps, and the glossy lobe
    shadowed,  ///< at the vertices without shadows and interpolated; shadow maps at each sample; matt
    given,     ///< each vertex brings its radiance
};

struct ShadingInfo {
    ShadingModel model;
    std::string_view name;
    std::string_view description;  ///< one line
};

/// All models by name, in the order in which to show them.
std::span<const ShadingInfo> shading_models();

/// Throws Error(usage) for an unknown name, listing the known ones.
ShadingModel shading_model(std::string_view name);

struct ShadingOptions {
    ShadingModel model = ShadingModel::vertex;
    std::size_t shadow_map = 512;   ///< texels along a side of a shadow map (see ShadowMap)
    double max_shadow_bytes = 8e9;  ///< of all shadow maps together
    bool filter_textures = true;    ///< average textures over what a sample covers
};

/// How much memory the shadow maps of a scene take: none where the model has no shadow maps.
double shadow_map_bytes(const Scene& scene, const ShadingOptions& options);

/// Makes a scene ready to be rendered. Meshes with given radiance show that in every model. Throws what
/// validate(Scene) throws; Error(bad_input) for a mesh without normals where there are lights, and, for `given`, for
/// one without radiance; Error(usage) where the shadow maps would take more memory than allowed.
ShadedScene shade_scene(const Scene& scene, const ShadingOptions& options, const Progress& progress = {});

/// Lights a scene at its vertices (Gouraud): radiance = emission + colour · (ambient + Σ E · max(0, n·l)/π) over the
/// lights that the vertex sees, E = intensity for a directional light and intensity/r² for a point light. Shadow rays
/// start a ten-thousandth of the scene's diagonal above the surface. Textures are point sampled. Cost: vertices ×
/// lights rays.
ShadedScene shade_scene_vertices(const Scene& scene);

/// A picture on a surface, repeated in both directions, with coarser versions of itself to be seen from afar.
class Texture {
  public:
    /// Point sampled unless `filtered`: then levels of half the size, each the mean of the one before, down to a single
    /// texel, are made (a third more memory).
    Texture(std::shared_ptr<const Image> finest, bool filtered = false);

    /// The picture interpolated between texels, averaged over about `width` texels of the finest level.
    Rgb sample(TextureCoordinate at, double width) const;
    /// Texels of the finest level in the unit square of texture coordinates.
    double texels() const { return static_cast<double>(finest_->width()) * static_cast<double>(finest_->height()); }
    bool filtered() const { return !coarser_.empty(); }

  private:
    std::shared_ptr<const Image> finest_;
    std::vector<Image> coarser_;
};

/// How a sample looks at a surface.
struct ViewSample {
    Vec3 to_viewer{0, 0, 1};  ///< unit length
    double footprint = 0;     ///< how wide the sample is on the surface, metres: textures are averaged over about that
};

/// Lighting that is worked out for each sample: a pure function of what a ray hits and where it comes from, so that
/// samples do not depend on the order or the tile in which they are asked for. It comes in two steps: the light that
/// falls on a point of a surface, which is dear and the same for all rays that see the point; and what a ray sees of
/// it.
class SampleLighting {
  public:
    /// Numbers that say what light falls on a point: some of any size from 0 up, then some between 0 and 1.
    struct Size {
        std::size_t any = 0, shares = 0;
        std::size_t sum() const { return any + shares; }
    };

    virtual ~SampleLighting() = default;
    /// How many numbers the light on a mesh takes; none where its vertices say it all.
    virtual Size size_of_light(std::size_t mesh) const = 0;
    /// Whether these are three numbers: the radiance before the texture, the same for whoever looks.
    virtual bool light_is_radiance(std::size_t mesh) const = 0;
    /// The light on the point of triangle `index` with these weights of its vertices, `size_of_light` numbers. They may
    /// be interpolated between points of one triangle.
    virtual void light_on(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                          std::span<float> light) const = 0;
    /// The radiance towards the viewer of the point under that light, on a mesh on which there is some. `texture`
    /// multiplies the base colour and the emission.
    virtual Rgb radiance(const ShadedScene& /*scene*/, std::size_t /*index*/, const std::array<float, 3>& /*weights*/,
                         std::span<const float> light, Rgb texture, const ViewSample& /*sight*/) const {
        return texture * Rgb{light[0], light[1], light[2]};
    }
};

/// A scene ready for any renderer: one list of triangles, and their light. Without `lighting` the radiance at a point
/// of a triangle is the interpolated vertex radiance times the texture.
struct ShadedScene {
    static constexpr std::uint32_t no_texture = std::numeric_limits<std::uint32_t>::max();

    struct Triangle {
        std::array<std::uint32_t, 3> vertices;
        std::uint32_t texture = no_texture;  ///< index into `textures`
        std::uint32_t mesh = 0;              ///< index of the mesh that it came from
    };

    std::vector<Vec3> positions;  ///< metres, world frame
    std::vector<Rgb> radiance;    ///< at the vertices, before the texture: reflected light plus emission
    std::vector<TextureCoordinate> texture_coordinates;  ///< as long as `positions`
    std::vector<Triangle> triangles;
    std::vector<Texture> textures;
    Rgb background;
    /// Whether a triangle is seen from its front alone, where its corners go round counterclockwise. Light falls on
    /// both sides and is kept off by both.
    bool fronts_only = false;
    std::shared_ptr<const SampleLighting> lighting;    ///< null where `radiance` says it all
    std::shared_ptr<shading::LightCache> light_cache;  ///< where light is kept for all rays (see cache_light); null:
                                                       ///< worked out for each ray

    /// Whether light is worked out for the samples of this triangle, and its vertices have none.
    bool is_lit(std::size_t index) const {
        return lighting && lighting->size_of_light(triangles[index].mesh).sum() > 0;
    }
    /// Whether interpolating the vertices' radiance is not all there is to this triangle.
    bool needs_samples(std::size_t index) const { return triangles[index].texture != no_texture || is_lit(index); }
};

/// The radiance at the point of triangle `index` with barycentric weights b0, b1, b2 (of its three vertices).
Rgb radiance_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2,
                const ViewSample& sight = {});

}  // namespace hogel
