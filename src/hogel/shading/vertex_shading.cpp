// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>
#include <vector>

#include "hogel/shading/lighting.h"
#include "hogel/shading/triangles.h"
#include "hogel/shading/vertex_visibility.h"
#include "hogel/work/parallel.h"

namespace hogel::shading {
namespace {

constexpr std::size_t vertices_per_task = 16;

// Calls `work` with each mesh without given radiance, the index of its first vertex, and each of its vertices.
template <class Work>
void for_lit_vertices(const Scene& scene, const Work& work) {
    std::size_t base = 0;
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t n = mesh.radiance.empty() ? mesh.positions.size() : 0;
        work::parallel_for((n + vertices_per_task - 1) / vertices_per_task, [&](std::size_t task) {
            const std::size_t first = task * vertices_per_task;
            for (std::size_t i = first; i < std::min(n, first + vertices_per_task); ++i) work(mesh, base, i);
        });
        base += mesh.positions.size();
    }
}

// Adds the irradiance of each vertex to its radiance, from shadow rays, with smooth shadow edges where suitable.
void add_irradiance(const Scene& scene, ShadedScene& shaded) {
    const trace::RayCaster caster = shadow_caster(scene, shaded, "vertex");
    if (VertexVisibility::suits(scene)) {
        const VertexVisibility visibility(scene, shaded, caster);
        for (std::size_t light = 0; light < scene.lights.size(); ++light) {
            const std::vector<float> values = visibility.irradiance(light);
            for (std::size_t i = 0; i < values.size(); ++i)
                if (values[i] > 0) shaded.radiance[i] += values[i] * scene.lights[light].intensity;
        }
        return;
    }
    const double scene_offset = ray_offset(scene);
    std::vector<double> offsets;
    for (const Mesh& mesh : scene.meshes) offsets.push_back(ray_offset(mesh, scene_offset));
    for_lit_vertices(scene, [&](const Mesh& mesh, std::size_t base, std::size_t i) {
        const double offset = offsets[static_cast<std::size_t>(&mesh - scene.meshes.data())];
        shaded.radiance[base + i] = irradiance(scene, caster, offset, mesh.positions[i], mesh.normals[i]);
    });
}

void light_vertices(const Scene& scene, ShadedScene& shaded) {
    if (!scene.lights.empty()) add_irradiance(scene, shaded);
    constexpr auto reflected = static_cast<float>(std::numbers::inv_pi);
    for_lit_vertices(scene, [&](const Mesh& mesh, std::size_t base, std::size_t i) {
        Rgb& value = shaded.radiance[base + i];
        const Rgb light = scene.ambient + reflected * value;
        value = vertex_color(mesh, i) * light + vertex_emission(mesh.material);
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
