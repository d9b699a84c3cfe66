// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/shadow_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/scene.h"
#include "hogel/shading/illumination.h"
#include "hogel/shading/test_scenes.h"

namespace hogel::shading {
namespace {

struct Blockers {
    explicit Blockers(const Scene& scene) : positions(), triangles(), caster(collect(scene)) {}
    trace::RayCaster collect(const Scene& scene) {
        for (const Mesh& mesh : scene.meshes) {
            const auto base = static_cast<std::uint32_t>(positions.size());
            positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
            for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({base + a, base + b, base + c});
        }
        return {positions, triangles};
    }
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    trace::RayCaster caster;
};

void add_square(Scene& scene, Vec3 center, Vec3 right, Vec3 up) { scene.meshes.push_back(square(center, right, up)); }

Light sun(Vec3 direction) {
    Light light;
    light.direction = normalize(direction);
    light.intensity = {1, 1, 1};
    return light;
}

ShadowMap map_of(const Scene& scene, const Light& light, std::size_t n) {
    const Blockers blockers(scene);
    ShadowMap map(light, bounds(scene), n);
    for (std::size_t row = 0; row < map.rows(); ++row) map.fill(blockers.caster, row);
    return map;
}

// A square above a floor, whose shadow's edges follow from similar triangles.
TEST(ShadowMap, edges_of_shadows_are_where_geometry_puts_them) {
    Scene scene;
    add_square(scene, {0, 0, 0}, {2, 0, 0}, {0, 2, 0});
    add_square(scene, {0, 0, 1}, {0.3, 0, 0}, {0, 0.3, 0});
    for (const Light& light : {lamp({0.1, 0.05, 3}, 1), sun({0.3, 0.1, -1})}) {
        constexpr std::size_t n = 256;
        const ShadowMap map = map_of(scene, light, n);
        const double texel = light.kind == Light::Kind::point ? 2 * 3.0 / n : 4.2 / (2 * n);
        std::size_t inside = 0, outside = 0;
        for (double x = -1.9; x < 1.9; x += 0.0137)
            for (double y = -1.9; y < 1.9; y += 0.0331) {
                const Vec3 to = illuminate(light, {x, y, 0}).to_light, p = Vec3{x, y, 0} + to / to.z;
                const double edge = std::max(std::abs(p.x), std::abs(p.y)) - 0.3;  // on the caster
                if (std::abs(edge) < 2.5 * texel) continue;
                ASSERT_EQ(map.visibility({x, y, 0}, {0, 0, 1}), edge < 0 ? 0.0f : 1.0f) << x << " " << y;
                (edge < 0 ? inside : outside)++;
            }
        EXPECT_GT(inside, 300u);
        EXPECT_GT(outside, 10000u);
    }
}

// For any slope and resolution of the map.
TEST(ShadowMap, a_flat_surface_never_shadows_itself) {
    std::mt19937 engine(9);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (double slant : {0.0, 30.0, 60.0, 80.0, 86.0})
        for (std::size_t n : {16, 128}) {
            const double angle = slant * 3.14159265 / 180;
            const Vec3 right{std::cos(angle), 0, std::sin(angle)}, up{0, 1, 0};
            Scene scene;
            add_square(scene, {0, 0, 0}, right, up);
            for (const Light& light : {lamp({0.2, 0.3, 2.5}, 1), sun({0.05, 0.1, -1})}) {
                const ShadowMap map = map_of(scene, light, n);
                for (int i = 0; i < 2000; ++i) {
                    const Vec3 p = coordinate(engine) * right + coordinate(engine) * up;
                    ASSERT_EQ(map.visibility(p, cross(right, up)), 1.0f) << slant << " " << n;
                    ASSERT_EQ(map.visibility(p, cross(up, right)), 1.0f) << slant << " " << n;
                }
            }
        }
}

// Compares with shadow rays on difficult scenes, except within two texels of a shadow's edge or a crease.
TEST(ShadowMap, neither_leaks_nor_speckles_on_built_in_scenes) {
    for (const char* name : {"pumpkin", "billiards", "tower"}) {
        const Scene scene = make_scene(name, 1);
        const Blockers blockers(scene);
        std::mt19937 engine(5);
        std::uniform_real_distribution<double> part(0, 1);
        for (const Light& light : scene.lights) {
            constexpr std::size_t n = 512;
            ShadowMap map(light, bounds(scene), n);
            for (std::size_t row = 0; row < map.rows(); ++row) map.fill(blockers.caster, row);
            std::size_t compared = 0, leaks = 0, speckles = 0;
            for (int i = 0; i < 4000; ++i) {
                const auto& [a, b, c] = blockers.triangles[engine() % blockers.triangles.size()];
                double w1 = part(engine), w2 = part(engine);
                if (w1 + w2 > 1) w1 = 1 - w1, w2 = 1 - w2;
                const Vec3 ab = blockers.positions[b] - blockers.positions[a];
                const Vec3 ac = blockers.positions[c] - blockers.positions[a];
                const Vec3 p = blockers.positions[a] + w1 * ab + w2 * ac, normal = normalize(cross(ab, ac));
                const Illumination from = illuminate(light, p);
                if (dot(normal, from.to_light) < 0.15) continue;
                // Shadow rays from around the point, at a distance of two texels.
                const double texel = light.kind == Light::Kind::point ? 2 * from.distance / n : 1.5 / (2 * n);
                const Vec3 side = normalize(cross(normal, from.to_light + Vec3{1e-3, 2e-3, 0})),
                           other = cross(normal, side);
                int seen = 0;
                const int around = 12;
                for (int k = 0; k < around; ++k) {
                    const double angle = 2 * 3.14159265 * k / around, r = (k % 2 == 0 ? 2.2 : 1.1) * texel;
                    const Vec3 q =
                        p + 1e-4 * normal + texel * normal + r * std::cos(angle) * side + r * std::sin(angle) * other;
                    const Illumination here = illuminate(light, q);
                    seen += blockers.caster.occluded(q, here.to_light, 0, here.distance) ? 0 : 1;
                }
                if (seen != 0 && seen != around) continue;
                ++compared;
                const float lit = map.visibility(p, normal);
                leaks += seen == 0 && lit > 0.5f;
                speckles += seen == around && lit < 0.5f;
            }
            EXPECT_GT(compared, 400u) << name;
            EXPECT_LE(leaks, compared / 200) << name << ", of " << compared;
            EXPECT_LE(speckles, compared * 3 / 200) << name << ", of " << compared;
        }
    }
}

TEST(ShadowMap, of_a_light_without_shadows_is_empty_and_everything_is_lit) {
    Scene scene;
    add_square(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    Light light = lamp({0, 0, -1}, 1);
    light.casts_shadows = false;
    const ShadowMap map(light, bounds(scene), 1024);
    EXPECT_EQ(map.rows(), 0u);
    EXPECT_EQ(ShadowMap::bytes(light, 1024), 0);
    EXPECT_EQ(map.visibility({0, 0, 0}, {0, 0, 1}), 1.0f);
}

TEST(ShadowMap, handles_a_light_on_a_surface_or_inside_a_body) {
    Scene scene;
    add_square(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const ShadowMap on = map_of(scene, lamp({0.2, 0.1, 0}, 1), 32);
    EXPECT_TRUE(std::isfinite(on.visibility({0.2, 0.1, 0}, {0, 0, 1})));
    EXPECT_TRUE(std::isfinite(on.visibility({0.5, 0.1, 0}, {0, 0, 1})));
    // A lamp between two plates lights the nearer sides of both; the third plate is in shadow.
    add_square(scene, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
    add_square(scene, {0, 0, 3}, {1, 0, 0}, {0, 1, 0});
    const ShadowMap between = map_of(scene, lamp({0, 0, 0.5}, 1), 64);
    EXPECT_EQ(between.visibility({0, 0, 1}, {0, 0, 1}), 1.0f);
    EXPECT_EQ(between.visibility({0, 0, 3}, {0, 0, 1}), 0.0f);
}

}  // namespace
}  // namespace hogel::shading
