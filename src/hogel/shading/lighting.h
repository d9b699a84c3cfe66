// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "hogel/shading.h"
#include "hogel/shading/shadow_map.h"

namespace hogel::shading {

/// Return the rows of shading_models(), each defined in its own file.
ShadingInfo vertex_shading();
ShadingInfo direct_shading();
ShadingInfo shadowed_shading();
ShadingInfo given_shading();

/// Computes ShadingInfo::shadow_map_bytes of models with a map of options.shadow_map texels for each light.
double bytes_of_shadow_maps(const Scene& scene, const ShadingOptions& options);

/// Returns the lighting of an earlier shading, to reuse its memory, if of the same type and not shared; else a new one.
template <class Lighting>
std::shared_ptr<Lighting> take_lighting(ShadedScene& shaded) {
    auto last = std::dynamic_pointer_cast<Lighting>(
        std::const_pointer_cast<SampleLighting>(std::exchange(shaded.lighting, nullptr)));
    return last && last.use_count() == 1 ? last : std::make_shared<Lighting>();
}

/// Returns the distance above a surface at which shadow rays start, so that a surface does not shadow itself: a
/// ten-thousandth of the scene's diagonal, in metres.
double ray_offset(const Scene& scene);

/// Returns the distance above one mesh at which shadow rays start. The discs of a point cloud (points_name) intersect,
/// so that corners of one lie under the next; there the distance is the discs' mean radius.
/// @param scene_offset  ray_offset() of the scene
double ray_offset(const Mesh& mesh, double scene_offset);

/// Returns the irradiance at a point of a surface from all lights that are visible from there.
Rgb irradiance(const Scene& scene, const trace::RayCaster& caster, double offset, Vec3 point, Vec3 normal);

/// Returns the colour of a vertex before the texture.
inline Rgb vertex_color(const Mesh& mesh, std::size_t vertex) {
    return mesh.colors.empty() ? mesh.material.base_color : mesh.material.base_color * mesh.colors[vertex];
}

/// Returns the emission of the vertices of a material; zero with an emission texture, because EmissionLighting adds it.
inline Rgb vertex_emission(const Material& material) {
    return material.emission_texture ? Rgb{0, 0, 0} : material.emission;
}

/// Interpolates a value between a triangle's vertices.
template <class T>
T interpolate(const std::vector<T>& values, const std::array<std::uint32_t, 3>& vertices,
              const std::array<float, 3>& weights) {
    return weights[0] * values[vertices[0]] + weights[1] * values[vertices[1]] + weights[2] * values[vertices[2]];
}

/// Position of a sample, and a normal of its triangle (of any length).
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
