// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/shading/gloss.h"
#include "hogel/shading/illumination.h"

namespace hogel::shading {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(GlossKernels);

TEST_P(GlossKernels, both_twins_give_the_sum_of_the_lobes_of_all_lamps_in_the_same_bits) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1), coordinate(-0.05, 0.05);
    const auto unit = [&] {
        return normalize(Vec3{coordinate(random), coordinate(random), 0.01 + std::abs(coordinate(random))});
    };
    double brightest = 0;
    for (int round = 0; round < 400; ++round) {
        std::vector<Light> lights(random() % 40);
        for (Light& light : lights) {
            light.kind = random() % 4 == 0 ? Light::Kind::directional : Light::Kind::point;
            light.position = {coordinate(random), coordinate(random), coordinate(random)};
            light.direction = {coordinate(random), coordinate(random), coordinate(random)};
            light.intensity = {float(part(random)), float(part(random)), random() % 3 == 0 ? 0 : float(part(random))};
        }
        Material material;
        material.reflectance = float(part(random));
        material.metallic = random() % 2 == 0 ? 0 : float(part(random));
        material.roughness = float(part(random));
        GlossyPoint point{{coordinate(random), coordinate(random), coordinate(random)}, unit(), unit()};
        if (!lights.empty() && round % 7 == 0) lights[0].position = point.position;  // does not light that point
        point.cos_view = dot(point.normal, point.to_viewer);
        if (!(point.cos_view > 0)) continue;
        const Reflection reflection(material, {0.9f, 0.5f, 0.1f}, point.cos_view);
        point.roughness = reflection.roughness();

        const LampTable lamps(lights);
        std::vector<float> visibility(lamps.size());
        Rgb expected{0, 0, 0};
        for (std::size_t i = 0; i < lights.size(); ++i) {
            visibility[i] = random() % 3 == 0 ? 0 : float(part(random));
            const Illumination from = illuminate(lights[i], point.position);
            expected += visibility[i] * float(from.falloff) *
                        (lights[i].intensity * reflection.lobe(point.normal, point.to_viewer, from.to_light,
                                                               dot(point.normal, from.to_light)));
        }
        const LightInLobe light = gloss(lamps, visibility.data(), point),
                          plain = gloss_plain(lamps, visibility.data(), point);
        ASSERT_EQ(light.scale, plain.scale) << round;
        ASSERT_EQ(light.offset, plain.offset) << round;
        const Rgb seen = reflection.lobe(light);
        for (const auto& [a, b] : {std::pair{seen.r, expected.r}, {seen.g, expected.g}, {seen.b, expected.b}})
            ASSERT_NEAR(a, b, 1e-3 * b + 1e-6) << round;
        brightest = std::max<double>(brightest, expected.r);
    }
    EXPECT_GT(brightest, 1);
}

}  // namespace
}  // namespace hogel::shading
