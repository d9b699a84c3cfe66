// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>
#include <vector>

#include "hogel/core/parallel.h"
#include "hogel/shading/illumination.h"
#include "hogel/shading/lighting.h"
#include "hogel/shading/triangles.h"
#include "hogel/shading/vertex_visibility.h"

namespace hogel::shading {
namespace {

constexpr std::size_t vertices_per_task = 4096;

// Calls `work` with each mesh that is lit, the number of its first vertex in the scene, and a range of its vertices.
template <class Work>
void for_lit_vertices(const Scene& scene, const Work& work) {
    std::size_t base = 0;
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t n = mesh.radiance.empty() ? mesh.positions.size() : 0;
        core::parallel_for((n + vertices_per_task - 1) / vertices_per_task, [&](std::size_t task) {
            const std::size_t first = task * vertices_per_task;
            work(mesh, base, first, std::min(n, first + vertices_per_task));
        });
        base += mesh.positions.size();
    }
}

// Adds the irradiance from a light to the radiance of vertices.
void add_irradiance(const Scene& scene, const Light& light, const std::vector<float>& visible,
                    std::vector<Rgb>& radiance) {
    for_lit_vertices(scene, [&](const Mesh& mesh, std::size_t base, std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            if (!(visible[base + i] > 0)) continue;
            const Illumination from = illuminate(light, mesh.positions[i]);
            const double cosine = dot(mesh.normals[i], from.to_light);
            radiance[base + i] += static_cast<float>(from.falloff * cosine) * visible[base + i] * light.intensity;
        }
    });
}

void light_vertices(const Scene& scene, ShadedScene& shaded) {
    const trace::RayCaster caster = shadow_caster(scene, shaded, "vertex");
    VertexVisibility visibility(scene, shaded, caster);
    for (const Light& light : scene.lights) add_irradiance(scene, light, visibility.of(light), shaded.radiance);
    constexpr auto reflected = static_cast<float>(std::numbers::inv_pi);
    for_lit_vertices(scene, [&](const Mesh& mesh, std::size_t base, std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            Rgb& value = shaded.radiance[base + i];
            const Rgb light = scene.ambient + reflected * value;
            value = vertex_color(mesh, i) * light + vertex_emission(mesh.material);
        }
    });
}

}  // namespace

ShadingInfo vertex_shading() {
    return {.name = "vertex",
            .text = "lit at the vertices, with shadows, and interpolated; matt",
            .make = [](const Scene& scene, const ShadingOptions&, ShadedScene& shaded, const Progress&) {
                light_vertices(scene, shaded);
                return nullptr;
            }};
}

}  // namespace hogel::shading
