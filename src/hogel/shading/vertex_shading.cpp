// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include "hogel/core/parallel.h"
#include "hogel/shading/lighting.h"
#include "hogel/shading/triangles.h"

namespace hogel::shading {
namespace {

constexpr std::size_t vertices_per_task = 16;

void light_vertices(const Scene& scene, ShadedScene& shaded) {
    const trace::RayCaster caster = shadow_caster(scene, shaded, "vertex");
    const double usual = ray_offset(scene);
    constexpr auto reflected = static_cast<float>(std::numbers::inv_pi);
    std::size_t base = 0;
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t n = mesh.positions.size();
        const double offset = ray_offset(mesh, usual);
        const std::size_t tasks = mesh.radiance.empty() ? (n + vertices_per_task - 1) / vertices_per_task : 0;
        core::parallel_for(tasks, [&](std::size_t task) {
            const std::size_t first = task * vertices_per_task;
            for (std::size_t i = first; i < std::min(n, first + vertices_per_task); ++i) {
                Rgb light = scene.ambient;
                if (!mesh.normals.empty())
                    light += reflected * irradiance(scene, caster, offset, mesh.positions[i], mesh.normals[i]);
                shaded.radiance[base + i] = vertex_color(mesh, i) * light + vertex_emission(mesh.material);
            }
        });
        base += n;
    }
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
