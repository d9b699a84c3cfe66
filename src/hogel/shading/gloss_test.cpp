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

TEST_P(GlossKernels, is_the_sum_of_the_lobes_of_all_lamps_and_the_same_bits_as_the_plain_twin) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1), place(-0.05, 0.05);
    const auto unit = [&] { return normalize(Vec3{place(random), place(random), 0.01 + std::abs(place(random))}); };
    double most = 0;
    for (int round = 0; round < 400; ++round) {
        std::vector<Light> lights(random() % 40);
        for (Light& light : lights) {
            light.kind = random() % 4 == 0 ? Light::Kind::directional : Light::Kind::point;
            light.position = {place(random), place(random), place(random)};
            light.direction = {place(random), place(random), place(random)};
            light.intensity = {float(part(random)), float(part(random)), random() % 3 == 0 ? 0 : float(part(random))};
        }
        Material material;
        material.reflectance = float(part(random));
        material.metallic = random() % 2 == 0 ? 0 : float(part(random));
        material.roughness = float(part(random));
        GlossyPoint point{{place(random), place(random), place(random)}, unit(), unit()};
        if (!lights.empty() && round % 7 == 0) lights[0].position = point.position;  // lights nothing
        point.cos_view = dot(point.normal, point.to_viewer);
        if (!(point.cos_view > 0)) continue;
        const Reflection reflection(material, {0.9f, 0.5f, 0.1f}, point.cos_view);
        point.roughness = reflection.roughness();

        const LampTable lamps(lights);
        std::vector<float> lit(lamps.size());
        Rgb expected{0, 0, 0};
        for (std::size_t i = 0; i < lights.size(); ++i) {
            lit[i] = random() % 3 == 0 ? 0 : float(part(random));
            const Illumination from = illuminate(lights[i], point.position);
            expected += lit[i] * float(from.falloff) *
                        (lights[i].intensity * reflection.lobe(point.normal, point.to_viewer, from.to_light,
                                                               dot(point.normal, from.to_light)));
        }
        const LightInLobe light = gloss(lamps, lit.data(), point), plain = gloss_plain(lamps, lit.data(), point);
        ASSERT_EQ(light.scale, plain.scale) << round;
        ASSERT_EQ(light.offset, plain.offset) << round;
        const Rgb seen = reflection.lobe(light);
        for (const auto& [a, b] : {std::pair{seen.r, expected.r}, {seen.g, expected.g}, {seen.b, expected.b}})
            ASSERT_NEAR(a, b, 1e-3 * b + 1e-6) << round;
        most = std::max<double>(most, expected.r);
    }
    EXPECT_GT(most, 1);
}

}  // namespace
}  // namespace hogel::shading
