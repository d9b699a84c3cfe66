#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "hogel/scene/scene.h"

namespace hogel {

/// A scene with its lighting done: one list of triangles with a radiance at each vertex, ready for any renderer. The
/// radiance at a point of a triangle is the interpolated vertex radiance (reflected light plus emission) times the
/// texture.
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
    std::vector<std::shared_ptr<const Image>> textures;
    Rgb background;
};

/// Lights a scene at its vertices (Gouraud): radiance = emission + colour · (ambient + Σ E · max(0, n·l)/π) over the
/// lights that the vertex sees, E = intensity for a directional light and intensity/r² for a point light. Shadow rays
/// start a ten-thousandth of the scene's diagonal above the surface. Throws what validate(Scene) throws, and
/// Error(bad_input) for a mesh without normals when there are lights. Cost: vertices × lights rays.
ShadedScene shade_vertices(const Scene& scene);

/// The radiance at the point of triangle `index` with barycentric weights b0, b1, b2 (of its three vertices).
Rgb radiance_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2);

}  // namespace hogel
