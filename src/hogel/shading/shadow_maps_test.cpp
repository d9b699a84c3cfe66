// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/shading/shadow_maps.h"
#include "hogel/shading/test_scenes.h"

namespace hogel::shading {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(ShadowMapKernels);

// Random squares between point and directional lights on all sides, some without shadows.
TEST_P(ShadowMapKernels, vector_and_plain_twin_give_the_same_bits) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto somewhere = [&] { return Vec3{coordinate(random), coordinate(random), coordinate(random)}; };
    Scene scene;
    for (int i = 0; i < 12; ++i)
        scene.meshes.push_back(square(somewhere(), 0.3 * normalize(somewhere()), 0.3 * normalize(somewhere())));
    for (int i = 0; i < 21; ++i) {
        Light light;
        light.kind = i % 5 == 1 ? Light::Kind::directional : Light::Kind::point;
        light.position = light.direction = somewhere();
        light.intensity = {1, 1, 1};
        light.casts_shadows = i % 7 != 3;
        scene.lights.push_back(light);
    }
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const Mesh& mesh : scene.meshes) {
        const auto base = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
        for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({base + a, base + b, base + c});
    }
    const ShadowMaps maps(make_shadow_maps(scene, trace::RayCaster(positions, triangles), 32));

    std::size_t dark = 0, between = 0, bright = 0;
    for (int round = 0; round < 3000; ++round) {
        Vec3 point = somewhere();
        const Vec3 normal = somewhere();
        const Vec3 lamp = scene.lights[random() % scene.lights.size()].position;
        if (round % 11 == 0) point = lamp;
        if (round % 13 == 0) point = lamp + Vec3{0.25, -0.25, 0.25};  // on an edge of the lamp's cube map
        if (round % 17 == 0) point = 5 * point;                       // beyond all stored depths
        std::vector<std::uint32_t> lamps(random() % 24);
        for (std::uint32_t& number : lamps) number = static_cast<std::uint32_t>(random() % scene.lights.size());
        std::vector<float> shares(lamps.size(), -1), plain(lamps.size(), -2);
        maps.visibility(lamps, point, normal, shares.data());
        maps.visibility_plain(lamps, point, normal, plain.data());
        ASSERT_EQ(shares, plain) << round;
        for (const float share : plain) ++(share == 0 ? dark : share == 1 ? bright : between);
    }
    EXPECT_GT(dark, 1000u);
    EXPECT_GT(between, 300u);
    EXPECT_GT(bright, 1000u);
}

}  // namespace
}  // namespace hogel::shading
