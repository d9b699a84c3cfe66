#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "hogel/scene/scene.h"
#include "hogel/shading/texture.h"

namespace hogel {

class RayCaster;
struct ShadedScene;

/// How a sample looks at a surface.
struct Sight {
    Vec3 to_viewer{0, 0, 1};  ///< unit length
    double footprint = 0;     ///< how wide the sample is on the surface, metres: textures are averaged over about that
};

/// Lighting that is worked out for each sample: a pure function of what a ray hits and where it comes from, so that
/// samples do not depend on the order or the tile in which they are asked for.
class SampleLighting {
  public:
    virtual ~SampleLighting() = default;
    /// The radiance towards the viewer at the point of triangle `index` with these weights of its vertices. `texture`
    /// multiplies the base colour and the emission.
    virtual Rgb radiance(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights, Rgb texture,
                         const Sight& sight) const = 0;
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
    std::shared_ptr<const SampleLighting> lighting;  ///< null where `radiance` says it all

    /// Whether interpolating the vertices' radiance is not all there is to this triangle.
    bool needs_samples(std::size_t index) const { return lighting || triangles[index].texture != no_texture; }
};

/// All triangles, numbered as in the scene, for rays to meet (trace/ray_caster.h).
RayCaster all_triangles(const ShadedScene& scene);

/// The radiance at the point of triangle `index` with barycentric weights b0, b1, b2 (of its three vertices).
Rgb radiance_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2, const Sight& sight = {});

}  // namespace hogel
