// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <stop_token>

#include "hogel/core/stop_scope.h"
#include "hogel/core/test_errors.h"
#include "hogel/error.h"
#include "hogel/scene/edges.h"

namespace hogel::scene {
namespace {

/// The box from −1 to 1, with two triangles per side and eight shared vertices.
Scene cube() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    mesh.triangles = {{4, 5, 7}, {4, 7, 6}, {1, 0, 2}, {1, 2, 3}, {5, 1, 3}, {5, 3, 7},
                      {0, 4, 6}, {0, 6, 2}, {6, 7, 3}, {6, 3, 2}, {0, 1, 5}, {0, 5, 4}};
    mesh.name = "cube";
    Scene scene;
    scene.meshes.push_back(mesh);
    return scene;
}

TEST(Normals, of_a_cube_are_split_at_its_edges) {
    Scene scene = cube();
    scene.meshes[0].colors.assign(8, {0.5f, 0, 0});
    add_missing_normals(scene, 0.5);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions.size(), 24u);
    EXPECT_NO_THROW(validate(scene));
    for (const auto& t : mesh.triangles) {
        const Vec3 a = mesh.positions[t[0]];
        const Vec3 flat = normalize(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
        for (std::uint32_t vertex : t) EXPECT_NEAR(dot(mesh.normals[vertex], flat), 1, 1e-12);
    }
}

TEST(Normals, of_a_cube_are_smooth_below_a_wide_crease_angle) {
    Scene scene = cube();
    add_missing_normals(scene, 1.7);
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.positions.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_GT(dot(mesh.normals[i], normalize(mesh.positions[i])), 0.9);
}

// Decimated scans have triangles that lie on a surface with their back upwards.
TEST(Normals, of_a_folded_triangle_are_those_of_its_neighbors) {
    constexpr std::uint32_t n = 6;
    Mesh sheet;
    for (std::uint32_t row = 0; row <= n; ++row)
        for (std::uint32_t column = 0; column <= n; ++column) sheet.positions.push_back({1.0 * column, 1.0 * row, 0});
    for (std::uint32_t row = 0; row < n; ++row)
        for (std::uint32_t column = 0; column < n; ++column) {
            const std::uint32_t a = row * (n + 1) + column, b = a + 1, c = a + n + 1, d = c + 1;
            sheet.triangles.push_back({a, b, d});
            sheet.triangles.push_back({a, d, c});
        }
    for (std::size_t folded = 0; folded < sheet.triangles.size(); ++folded) {
        Scene scene;
        scene.meshes = {sheet};
        std::swap(scene.meshes[0].triangles[folded][1], scene.meshes[0].triangles[folded][2]);
        add_missing_normals(scene, 1);
        const bool at_corner = folded == 1 + 2 * n * (n - 1) || folded == 2 * (n - 1);  // with two free sides
        if (at_corner) continue;
        EXPECT_EQ(scene.meshes[0].positions.size(), sheet.positions.size()) << folded;
        for (const Vec3& normal : scene.meshes[0].normals) EXPECT_EQ(normal, (Vec3{0, 0, 1})) << folded;
    }
}

TEST(Normals, are_smooth_between_triangles_that_share_only_positions) {
    Scene soup;
    soup.meshes.emplace_back();
    const Scene box = cube();
    for (const auto& t : box.meshes[0].triangles) {
        const auto base = static_cast<std::uint32_t>(soup.meshes[0].positions.size());
        for (std::uint32_t vertex : t) soup.meshes[0].positions.push_back(box.meshes[0].positions[vertex]);
        soup.meshes[0].triangles.push_back({base, base + 1, base + 2});
    }
    Scene shared = cube();
    add_missing_normals(soup, 1.7);
    add_missing_normals(shared, 1.7);
    for (std::size_t t = 0; t < 12; ++t)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(soup.meshes[0].normals[soup.meshes[0].triangles[t][k]],
                      shared.meshes[0].normals[shared.meshes[0].triangles[t][k]]);
}

TEST(Normals, of_a_fine_sphere_are_radial_and_existing_ones_stay) {
    Scene scene;
    Mesh ball;
    constexpr std::uint32_t rows = 60, columns = 120;
    for (std::uint32_t i = 0; i <= rows; ++i)
        for (std::uint32_t k = 0; k <= columns; ++k) {
            const double a = std::numbers::pi * i / rows, b = 2 * std::numbers::pi * (k % columns) / columns;
            ball.positions.push_back({std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b)});
            if (i == rows || k == columns) continue;
            const std::uint32_t here = i * (columns + 1) + k, below = here + columns + 1;
            ball.triangles.push_back({here, below, below + 1});
            ball.triangles.push_back({here, below + 1, here + 1});
        }
    scene.meshes = {ball, cube().meshes[0]};
    scene.meshes[1].normals.assign(8, {0, 1, 0});
    add_missing_normals(scene, 0.5);
    for (const auto& t : scene.meshes[0].triangles) {
        const auto& p = scene.meshes[0].positions;
        if (length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) < 1e-9) continue;  // at the poles
        for (std::uint32_t vertex : t) EXPECT_GT(dot(scene.meshes[0].normals[vertex], p[vertex]), 0.999);
    }
    EXPECT_EQ(scene.meshes[1].normals, std::vector<Vec3>(8, Vec3{0, 1, 0}));
}

TEST(Scene, validation_names_the_faulty_element) {
    const auto complaint = [](const Scene& scene) -> std::string {
        try {
            validate(scene);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(complaint(cube()), "");
    EXPECT_NE(complaint({}).find("no triangles"), std::string::npos);
    Scene scene = cube();
    scene.meshes[0].triangles[3][1] = 8;
    EXPECT_NE(complaint(scene).find("mesh 'cube': triangle 3 has vertex index 8"), std::string::npos);
    scene = cube();
    scene.meshes[0].positions[5].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(complaint(scene).find("positions of vertex 5"), std::string::npos);
    scene = cube();
    scene.meshes[0].normals.resize(7);
    EXPECT_NE(complaint(scene).find("7 normals; expected 8"), std::string::npos);
    scene.meshes[0].normals.assign(8, {0, 0, 1});
    scene.meshes[0].normals[2].z = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(complaint(scene).find("normals of vertex 2"), std::string::npos);
    scene = cube();
    scene.meshes[0].colors.assign(8, {1, 1, std::numeric_limits<float>::infinity()});
    EXPECT_NE(complaint(scene).find("colors of vertex 0"), std::string::npos);
}

TEST(Scene, bounds_hold_the_vertices_of_triangles_only) {
    Scene scene = cube();
    scene.meshes[0].positions.push_back({100, 0, 0});
    EXPECT_EQ(bounds(scene).low, (Vec3{-1, -1, -1}));
    EXPECT_EQ(bounds(scene).high, (Vec3{1, 1, 1}));
    EXPECT_EQ(triangle_count(scene), 12u);
    EXPECT_THROW(bounds(Scene{}), Error);
}

// Each change gives another checksum, except names.
TEST(Scene, checksum_covers_everything_visible) {
    const auto picture = [](float value) {
        auto image = std::make_shared<Image>(2, 3, 3);
        image->pixels(1, 1, 2) = value;
        return image;
    };
    const std::vector<std::function<void(Scene&)>> changes{
        [](Scene&) {},
        [](Scene& s) { s.meshes[0].positions[5].y += 1e-15; },
        [](Scene& s) { std::swap(s.meshes[0].triangles[0], s.meshes[0].triangles[1]); },
        [](Scene& s) {
            s.meshes[0].normals.assign(8, {0, 0, 1});
        },
        [](Scene& s) {
            s.meshes[0].colors.assign(8, {1, 1, 1});
        },
        [](Scene& s) {
            s.meshes[0].radiance.assign(8, {1, 1, 1});
        },
        [](Scene& s) { s.meshes[0].texture_coordinates.assign(8, {}); },
        [](Scene& s) { s.meshes[0].material.base_color.g = 0.7f; },
        [](Scene& s) { s.meshes[0].material.roughness = 0.5f; },
        [](Scene& s) { s.meshes[0].material.emission.b = 1; },
        [&](Scene& s) { s.meshes[0].material.base_color_texture = picture(0); },
        [&](Scene& s) { s.meshes[0].material.base_color_texture = picture(0.5f); },
        [](Scene& s) { s.meshes.push_back(s.meshes[0]); },
        [](Scene& s) { s.lights.emplace_back(); },
        [](Scene& s) { s.lights.emplace_back().casts_shadows = false; },
        [](Scene& s) { s.lights.emplace_back().position.x = 1; },
        [](Scene& s) { s.ambient.r = 1; },
        [](Scene& s) { s.background.r = 1; },
    };
    std::set<std::uint32_t> sums;
    for (const auto& change : changes) {
        Scene scene = cube(), renamed = cube();
        change(scene);
        change(renamed);
        renamed.meshes[0].name = renamed.name = "other";
        sums.insert(checksum(scene));
        EXPECT_EQ(checksum(renamed), checksum(scene));
    }
    EXPECT_EQ(sums.size(), changes.size());
}

TEST(Fit, fills_the_hologram_at_the_given_depth) {
    for (double front : {0.0, 0.25, 1.0}) {
        Scene scene = cube();
        for (Vec3& p : scene.meshes[0].positions) p = Vec3{3 * p.x + 7, p.y - 2, 2 * p.z + 1};
        fit_scene(scene, {0.02, 0.01, 0.9, front});
        const auto [low, high] = bounds(scene);
        EXPECT_NEAR(high.x - low.x, 0.9 * 0.02, 1e-15);
        EXPECT_NEAR(high.y - low.y, 0.9 * 0.02 / 3, 1e-15);
        EXPECT_NEAR(low.x + high.x, 0, 1e-15);
        EXPECT_NEAR(low.y + high.y, 0, 1e-15);
        EXPECT_NEAR(high.z, front * (high.z - low.z), 1e-15);
    }
}

TEST(Fit, keeps_the_irradiance_of_point_lights) {
    Scene scene = cube();
    Light light;
    light.kind = Light::Kind::point;
    light.position = {4, 5, 6};
    light.intensity = {2, 2, 2};
    scene.lights = {light};
    const auto irradiance = [&] {
        const Vec3 to_light = scene.lights[0].position - scene.meshes[0].positions[7];
        return scene.lights[0].intensity.r / dot(to_light, to_light);
    };
    const double before = irradiance();
    fit_scene(scene, {0.02, 0.02, 0.85, 0.5});
    EXPECT_NEAR(irradiance(), before, 1e-6 * before);
}

TEST(Fit, refuses_scenes_and_holograms_without_size) {
    Scene flat = cube();
    for (Vec3& p : flat.meshes[0].positions) p = {1, 1, p.z};
    EXPECT_THROW(fit_scene(flat, {0.02, 0.02, 0.85, 0}), Error);
    Scene scene = cube();
    EXPECT_THROW(fit_scene(scene, {0, 0.02, 0.85, 0}), Error);
}

TEST(DefaultLights, come_from_the_front_and_are_directional) {
    Scene scene = cube();
    add_default_lights(scene);
    ASSERT_EQ(scene.lights.size(), 2u);
    for (const Light& light : scene.lights) {
        EXPECT_EQ(light.kind, Light::Kind::directional);
        EXPECT_NEAR(length(light.direction), 1, 1e-12);
        EXPECT_LT(light.direction.z, 0);
    }
    EXPECT_GT(scene.lights[0].direction.x, 0);  // the key light comes from the upper left
    EXPECT_LT(scene.lights[0].direction.y, 0);
}

TEST(Normals, of_a_mesh_end_when_a_stop_is_requested) {
    Mesh mesh = make_scene("sphere", 1).meshes.front();
    const std::vector<scene::TriangleEdge> edges = scene::sorted_edges(mesh);
    std::stop_source stop;
    const core::StopScope scope{Progress(stop.get_token())};
    EXPECT_FALSE(core::is_cancelled([&] { scene::add_normals(mesh, edges, 1); }));
    stop.request_stop();
    EXPECT_TRUE(core::is_cancelled([&] { scene::sorted_edges(mesh); }));
    EXPECT_TRUE(core::is_cancelled([&] { scene::add_normals(mesh, edges, 1); }));
}

}  // namespace
}  // namespace hogel::scene
