// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "hogel/render/epi/kernels.h"
#include "hogel/shading.h"

namespace hogel::render::epi {

/// Returns triangles around the middle of the hologram, on both sides. Corners are at most `max_distance` from the
/// middle along each axis; every third triangle has corners of equal height. Radiances are (triangle, corner, 0).
inline ShadedScene scattered_triangles(std::size_t count, double max_distance) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-4e-3, 4e-3), offset(-max_distance, max_distance);
    ShadedScene scene;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 middle{coordinate(random), coordinate(random), coordinate(random)};
        for (int corner = 0; corner < 3; ++corner) {
            scene.positions.push_back(middle + Vec3{offset(random), i % 3 == 0 ? 0 : offset(random), offset(random)});
            scene.radiance.push_back({float(i), float(corner), 0});
        }
        scene.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, ShadedScene::no_texture, 0});
    }
    return scene;
}

}  // namespace hogel::render::epi
