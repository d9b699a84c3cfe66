// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/triangles.h"

namespace hogel::shading {
namespace {

trace::RayCaster ray_caster(const ShadedScene& scene, trace::Sides sides) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(scene.triangles.size());
    for (const ShadedScene::Triangle& triangle : scene.triangles) triangles.push_back(triangle.vertices);
    return {scene.positions, triangles, sides};
}

}  // namespace

trace::RayCaster all_triangles(const ShadedScene& scene) { return ray_caster(scene, trace::Sides::both); }

trace::RayCaster seen_triangles(const ShadedScene& scene) {
    return ray_caster(scene, scene.fronts_only ? trace::Sides::fronts : trace::Sides::both);
}

}  // namespace hogel::shading
