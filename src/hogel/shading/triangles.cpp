// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/triangles.h"

#include <fmt/format.h>

#include <algorithm>

#include "hogel/core/part.h"

namespace hogel::shading {
namespace {

// Below 0.5 by the rounding of a product of floats.
constexpr float half_opaque = 0.5f - 1.0f / 1024;

void set_triangles(trace::RayCaster& caster, const ShadedScene& scene, trace::Sides sides) {
    trace::TriangleMesh mesh = caster.release();
    mesh.positions = scene.positions;
    mesh.is_solid = {};
    if (!scene.mesh_alphas.empty())
        mesh.is_solid = [&scene](std::uint32_t triangle, float b1, float b2) {
            return opacity_at(scene, triangle, 1 - b1 - b2, b1, b2) >= half_opaque;
        };
    mesh.triangles.resize(scene.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) mesh.triangles[i] = scene.triangles[i].vertices;
    caster.set(std::move(mesh), sides);
}

}  // namespace

trace::RayCaster all_triangles(const ShadedScene& scene) {
    trace::RayCaster caster;
    set_triangles(caster, scene, trace::Sides::both);
    return caster;
}

trace::RayCaster shadow_caster(const Scene& scene, const ShadedScene& shaded, const char* model) {
    if (std::ranges::none_of(scene.lights, &Light::casts_shadows)) return {};
    core::require_part("Embree", fmt::format("shadows, in the shading model '{}'", model));
    return all_triangles(shaded);
}

void set_seen_triangles(trace::RayCaster& caster, const ShadedScene& scene) {
    set_triangles(caster, scene, scene.fronts_only ? trace::Sides::fronts : trace::Sides::both);
}

}  // namespace hogel::shading
