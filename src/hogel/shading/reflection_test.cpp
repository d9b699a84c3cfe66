// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/reflection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace hogel::shading {
namespace {

using std::numbers::pi;

Material material(float reflectance, float metallic, float roughness) {
    Material m;
    m.base_color = {1, 1, 1};
    m.reflectance = reflectance, m.metallic = metallic, m.roughness = roughness;
    return m;
}

Vec3 at_angle(double cosine, double around) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(around), sine * std::sin(around), cosine};
}

/// The radiance towards the viewer in uniform light of radiance 1, as a sum over the directions of the light.
double in_uniform_light(const Material& m, double cos_view, Rgb color = {1, 1, 1}) {
    const Vec3 normal{0, 0, 1}, to_viewer = at_angle(cos_view, 0);
    const Reflection reflection(m, color, cos_view);
    constexpr int rows = 500, columns = 240;
    double sum = 0;
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k) {
            // Uniform in the polar angle and, with the azimuth π (1 + x³), dense around the mirror direction, where
            // lobes at grazing angles are narrow.
            const double polar = 0.5 * pi * (i + 0.5) / rows, x = 2 * (k + 0.5) / columns - 1;
            const Vec3 to_light = at_angle(std::cos(polar), pi * (1 + x * x * x));
            sum += reflection.towards(normal, to_viewer, to_light, to_light.z).r * std::sin(polar) * 3 * pi * x * x;
        }
    return sum * (0.5 * pi / rows) * (2.0 / columns);
}

TEST(Reflection, a_white_surface_in_uniform_light_has_the_radiance_of_that_light) {
    for (const float roughness : {0.3f, 0.6f, 1.0f})
        for (const double cosine : {0.1, 0.5, 0.95})
            EXPECT_NEAR(in_uniform_light(material(0.04f, 0, roughness), cosine), 1, 0.01) << roughness << " " << cosine;
}

TEST(Reflection, never_reflects_more_than_it_receives) {
    for (const float reflectance : {0.04f, 0.5f, 1.0f})
        for (const float metallic : {0.0f, 1.0f})
            for (const float roughness : {0.25f, 0.7f})
                for (const double cosine : {0.05, 0.6})
                    EXPECT_LT(in_uniform_light(material(reflectance, metallic, roughness), cosine), 1.01);
}

TEST(Reflection, in_uniform_light_equals_the_sum_over_directions) {
    for (const float metallic : {0.0f, 1.0f})
        for (const double cosine : {0.2, 0.9}) {
            const Material m = material(0.06f, metallic, 0.4f);
            const Rgb color{0.5f, 0.5f, 0.5f};
            EXPECT_NEAR(in_uniform_light(m, cosine, color), Reflection(m, color, cosine).in_uniform_light().r, 0.01);
        }
}

TEST(Reflection, is_reciprocal) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> cosine(0.02, 1), around(0, 2 * pi), part(0, 1);
    const Vec3 normal{0, 0, 1};
    for (int i = 0; i < 1000; ++i) {
        const Material m = material(float(part(engine)), float(part(engine)), float(part(engine)));
        const Rgb color{float(part(engine)), float(part(engine)), float(part(engine))};
        const Vec3 a = at_angle(cosine(engine), around(engine)), b = at_angle(cosine(engine), around(engine));
        const Rgb there = Reflection(m, color, a.z).towards(normal, a, b, b.z);
        const Rgb back = Reflection(m, color, b.z).towards(normal, b, a, a.z);
        ASSERT_NEAR(there.r / b.z, back.r / a.z, 1e-5 * there.r / b.z);
        ASSERT_NEAR(there.b / b.z, back.b / a.z, 1e-5 * there.b / b.z);
    }
}

TEST(Reflection, without_a_lobe_is_lambertian) {
    const Reflection matt(material(0, 0, 0.2f), {0.5f, 0.25f, 1}, 0.3);
    const Rgb seen = matt.towards({0, 0, 1}, at_angle(0.3, 1), at_angle(0.8, 2), 0.8);
    EXPECT_NEAR(seen.r, 0.5 * 0.8 / pi, 1e-6);
    EXPECT_NEAR(seen.g, 0.25 * 0.8 / pi, 1e-6);
    EXPECT_EQ(matt.in_uniform_light(), (Rgb{0.5f, 0.25f, 1}));
}

// At normal incidence, n = l = v: D = 1/(π α²) and no masking, so the radiance is F/(4π α²).
TEST(Reflection, the_peak_of_the_lobe_has_its_closed_form) {
    const double alpha = 0.5 * 0.5;
    Material m = material(0, 1, 0.5f);
    const Rgb seen = Reflection(m, {0.9f, 0.6f, 0.3f}, 1).towards({0, 0, 1}, {0, 0, 1}, {0, 0, 1}, 1);
    EXPECT_NEAR(seen.r, 0.9 / (4 * pi * alpha * alpha), 1e-4);
    EXPECT_NEAR(seen.b, 0.3 / (4 * pi * alpha * alpha), 1e-4);
}

TEST(Reflection, the_lobe_is_not_seen_from_behind) {
    const Reflection metal(material(0, 1, 0.3f), {1, 1, 1}, -0.5);
    EXPECT_EQ(metal.towards({0, 0, 1}, {0, 0, -1}, {0, 0, 1}, 1), (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace hogel::shading
