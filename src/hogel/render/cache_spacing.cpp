// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/cache_spacing.h"

#include <algorithm>
#include <cmath>

namespace hogel::render {

std::vector<float> cache_spacing(const ShadedScene& scene, const LightFieldGrid& front, double share) {
    const double step = std::max(front.step_u(), front.step_v());
    std::vector<float> spacing;
    spacing.reserve(scene.triangles.size());
    for (const ShadedScene::Triangle& triangle : scene.triangles) {
        const auto [a, b, c] = triangle.vertices;
        const auto [low, high] = std::minmax({scene.positions[a].z, scene.positions[b].z, scene.positions[c].z});
        const double nearest = std::max({low, -high, 0.0});  // 0 if it crosses the plane
        spacing.push_back(static_cast<float>(share * std::max(front.pitch, nearest * step)));
    }
    return spacing;
}

}  // namespace hogel::render
