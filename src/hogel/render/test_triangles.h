// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "hogel/render/epi/kernels.h"
#include "hogel/shading.h"

namespace hogel::render {

/// Triangles for tests, all around the middle of the hologram and on both sides of it, no corner farther than `reach`
/// from a triangle's middle along an axis; every third one has corners of the same height. Radiances tell triangle and
/// corner.
inline ShadedScene scattered_triangles(std::size_t count, double reach) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-4e-3, 4e-3), size(-reach, reach);
    ShadedScene scene;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 middle{place(random), place(random), place(random)};
        for (int corner = 0; corner < 3; ++corner) {
            scene.positions.push_back(middle + Vec3{size(random), i % 3 == 0 ? 0 : size(random), size(random)});
            scene.radiance.push_back({float(i), float(corner), 0});
        }
        scene.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, ShadedScene::no_texture, 0});
    }
    return scene;
}

/// A test of the vector kernels as they are built for one instruction set that this processor has (kernel_targets).
class KernelTargetTest : public ::testing::TestWithParam<std::int64_t> {
  protected:
    void SetUp() override { epi::use_kernel_target(GetParam()); }
    void TearDown() override { epi::use_kernel_target(0); }
};

}  // namespace hogel::render
