// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/shading.h"
#include "hogel/shading/shadow_map.h"

namespace hogel::shading {

/// ShadingModel::direct and ShadingModel::shadowed for a scene whose geometry is that of the shaded scene's meshes in
/// order. `maps` has one map a light.
std::unique_ptr<SampleLighting> make_direct_lighting(const Scene& scene, std::vector<ShadowMap> maps);
std::unique_ptr<SampleLighting> make_shadowed_lighting(const Scene& scene, std::vector<ShadowMap> maps);

/// Rays start this far above a surface, a ten-thousandth of the scene's diagonal, so that a point does not stand in its
/// own light.
double ray_offset(const Scene& scene);

/// The irradiance from all lights that a point of a surface sees.
Rgb irradiance(const Scene& scene, const trace::RayCaster& caster, double offset, Vec3 point, Vec3 normal);

/// The colour of a vertex before the texture.
inline Rgb vertex_color(const Mesh& mesh, std::size_t vertex) {
    return mesh.colors.empty() ? mesh.material.base_color : mesh.material.base_color * mesh.colors[vertex];
}

/// Interpolates one value of each of a triangle's vertices.
template <class T>
T interpolate(const std::vector<T>& values, const std::array<std::uint32_t, 3>& vertices,
              const std::array<float, 3>& weights) {
    return weights[0] * values[vertices[0]] + weights[1] * values[vertices[1]] + weights[2] * values[vertices[2]];
}

/// Where a sample lies, and a normal of its triangle (of any length).
struct SurfacePoint {
    Vec3 position, flat_normal;

    SurfacePoint(const ShadedScene& scene, const std::array<std::uint32_t, 3>& vertices,
                 const std::array<float, 3>& weights) {
        const Vec3 a = scene.positions[vertices[0]], ab = scene.positions[vertices[1]] - a,
                   ac = scene.positions[vertices[2]] - a;
        position = a + double{weights[1]} * ab + double{weights[2]} * ac;
        flat_normal = cross(ab, ac);
    }
};

}  // namespace hogel::shading
