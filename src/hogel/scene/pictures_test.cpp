// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "hogel/core/test_errors.h"

namespace hogel::scene {
namespace {

Image grey(std::size_t width, std::size_t height, float value = 0.5f) {
    Image image(width, height, 1);
    for (float& each : image.pixels.elements()) each = value;
    return image;
}

Array<float, 2> map_of(std::size_t width, std::size_t height,
                       const std::function<float(std::size_t, std::size_t)>& value) {
    Array<float, 2> map({height, width});
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) map(y, x) = value(x, y);
    return map;
}

/// Twice the area of a triangle as the viewer sees it; negative if it shows its back.
double seen_area(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const Vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]], c = mesh.positions[triangle[2]];
    return cross(b - a, c - a).z;
}

Bounds bounds_of(const Mesh& mesh) {
    Scene scene;
    scene.meshes.push_back(mesh);
    return bounds(scene);
}

TEST(Pictures, are_rectangles_of_their_radiance) {
    const Scene scene = scene_of_picture(grey(4, 3));
    validate(scene);
    ASSERT_EQ(triangle_count(scene), 2u);
    const Mesh& mesh = scene.meshes[0];
    const auto [low, high] = bounds(scene);
    EXPECT_EQ(low, (Vec3{-0.5, -0.375, 0}));
    EXPECT_EQ(high, (Vec3{0.5, 0.375, 0}));
    EXPECT_EQ(mesh.radiance, std::vector<Rgb>(4, Rgb{1, 1, 1}));
    for (std::size_t i = 0; i < 4; ++i) {  // the texture lies upright on the rectangle
        EXPECT_FLOAT_EQ(mesh.texture_coordinates[i].u, static_cast<float>(mesh.positions[i].x + 0.5));
        EXPECT_FLOAT_EQ(mesh.texture_coordinates[i].v, static_cast<float>(mesh.positions[i].y / 0.75 + 0.5));
    }
    EXPECT_EQ(mesh.material.base_color_texture->pixels(0, 0, 0), 0.5f);
}

TEST(Pictures, keep_alpha_only_where_something_is_transparent) {
    Image picture(2, 1, 4);
    for (float& value : picture.pixels.elements()) value = 1;
    EXPECT_EQ(scene_of_picture(picture).meshes[0].material.alpha_mode, AlphaMode::opaque);
    picture.pixels(0, 1, 3) = 0.5f;
    EXPECT_EQ(scene_of_picture(picture).meshes[0].material.alpha_mode, AlphaMode::blend);
}

TEST(Pictures, have_only_finite_light) {
    Image picture = grey(3, 1);
    picture.pixels(0, 0, 0) = std::numeric_limits<float>::quiet_NaN();
    picture.pixels(0, 1, 0) = -1;
    const Scene scene = scene_of_picture(picture);
    const Image& shown = *scene.meshes[0].material.base_color_texture;
    EXPECT_EQ(shown.pixels(0, 0, 0), 0);
    EXPECT_EQ(shown.pixels(0, 1, 0), 0);
    EXPECT_EQ(shown.pixels(0, 2, 0), 0.5f);
}

// Whatever the map, the front surface covers the picture once, facing the viewer, and each of its triangles shows its
// own part of the picture to within half a pixel.
TEST(DepthMaps, cover_the_picture_seen_from_the_front) {
    std::mt19937 random(1);
    constexpr std::size_t width = 17, height = 11;
    for (int levels : {2, 3, 9, 1000}) {
        const auto map = map_of(width, height, [&](auto, auto) { return static_cast<float>(random() % levels); });
        const Scene scene = scene_of_picture(grey(34, 22), map);
        validate(scene);
        const Mesh& mesh = scene.meshes[0];
        ASSERT_EQ(mesh.triangles.size(), 2 * width * height);
        double area = 0;
        for (const auto& triangle : mesh.triangles) {
            EXPECT_NEAR(seen_area(mesh, triangle), 1.0 / (width * width), 1e-12);
            area += 0.5 * seen_area(mesh, triangle);
        }
        EXPECT_NEAR(area, static_cast<double>(height) / width, 1e-12);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_LE(std::abs(mesh.texture_coordinates[i].u - (mesh.positions[i].x + 0.5)), 0.501 / width);
            EXPECT_LE(std::abs(mesh.texture_coordinates[i].v - (mesh.positions[i].y * width / height + 0.5)),
                      0.501 / height);
        }
    }
}

TEST(DepthMaps, stretch_nothing_across_edges) {
    std::mt19937 random(2);
    const auto map = map_of(20, 20, [&](auto, auto) { return static_cast<float>(random() % 4); });
    const Scene scene = scene_of_picture(grey(20, 20), map);
    for (const Mesh& mesh : scene.meshes)
        for (const auto& [a, b, c] : mesh.triangles) {
            const auto [low, high] = std::minmax({mesh.positions[a].z, mesh.positions[b].z, mesh.positions[c].z});
            EXPECT_LE(high - low, 0.25 * 2 * edge_step) << mesh.name;
        }
}

TEST(DepthMaps, of_planes_are_planes) {
    const auto slope = [](double x, double y) { return 0.1 * x - 0.07 * y; };
    const auto map = map_of(30, 20, [&](std::size_t x, std::size_t y) {
        return static_cast<float>(slope(static_cast<double>(x), static_cast<double>(y)));
    });
    DepthMapOptions options;
    options.near = -2e-3;
    options.far = 3e-3;
    const Scene scene = scene_of_picture(grey(30, 20), map, options);
    EXPECT_EQ(scene.units, SceneUnits::depths);
    ASSERT_EQ(scene.meshes.size(), 1u);  // without an edge nothing continues behind
    const double lowest = slope(0, 19), range = slope(29, 0) - lowest;
    for (const Vec3& p : scene.meshes[0].positions) {
        const double x = (p.x + 0.5) * 30 - 0.5, y = 9.5 - p.y * 30;
        if (x < 0 || x > 29 || y < 0 || y > 19) continue;
        EXPECT_NEAR(p.z, -3e-3 + 5e-3 * (slope(x, y) - lowest) / range, 1e-8);
    }
}

// The nearest and the farthest values are at the given depths, and between them depth is as the kind of values says.
TEST(DepthMaps, have_depths_by_the_meaning_of_their_values) {
    const auto map = map_of(3, 1, [](std::size_t x, auto) { return x == 0 ? 10.0f : x == 1 ? 40.0f : 110.0f; });
    DepthMapOptions options;
    options.near = -20e-3;
    options.far = 100e-3;
    const auto depths = [&](DepthValues values) {
        options.values = values;
        const Mesh mesh = scene_of_picture(grey(3, 1), map, options).meshes[0];
        std::array<double, 3> result{};
        for (std::size_t i = 0; i < 3; ++i) result[i] = -mesh.positions[mesh.triangles[2 * i][0]].z;
        return result;
    };
    const auto nearness = depths(DepthValues::nearness), distance = depths(DepthValues::distance),
               disparity = depths(DepthValues::disparity);
    EXPECT_NEAR(nearness[0], 100e-3, 1e-9);
    EXPECT_NEAR(nearness[1], 100e-3 - 0.3 * 120e-3, 1e-8);
    EXPECT_NEAR(nearness[2], -20e-3, 1e-9);
    EXPECT_NEAR(distance[0], -20e-3, 1e-9);
    EXPECT_NEAR(distance[1], -20e-3 + 0.3 * 120e-3, 1e-8);
    EXPECT_NEAR(distance[2], 100e-3, 1e-9);
    EXPECT_NEAR(disparity[0], 100e-3, 1e-9);
    EXPECT_NEAR(disparity[1], 1 / (1 / 0.4 + 0.3 * (1 / 0.28 - 1 / 0.4)) - 0.3, 1e-8);
    EXPECT_NEAR(disparity[2], -20e-3, 1e-9);
}

TEST(DepthMaps, put_the_background_of_renderers_farthest) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    for (const float background : {1e10f, inf, -inf, std::numeric_limits<float>::quiet_NaN()}) {
        const auto map = map_of(3, 1, [&](std::size_t x, auto) { return x == 0 ? 2.0f : x == 1 ? background : 4.0f; });
        DepthMapOptions options;
        options.values = DepthValues::distance;
        const Mesh mesh = scene_of_picture(grey(3, 1), map, options).meshes[0];
        const auto z = [&](std::size_t pixel) { return mesh.positions[mesh.triangles[2 * pixel][0]].z; };
        EXPECT_NEAR(z(0), 0.25, 1e-9);
        EXPECT_NEAR(z(1), 0, 1e-9);
        EXPECT_NEAR(z(2), 0, 1e-9);
    }
}

// Behind the edge of a near half, the far half continues with its own colour by a twelfth of the width.
TEST(DepthMaps, continue_the_farther_surface_behind_edges) {
    constexpr std::size_t width = 120, height = 10;
    const auto map = map_of(width, height, [](std::size_t x, auto) { return x < width / 2 ? 0.0f : 1.0f; });
    Image picture(width, height, 3);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) picture.pixels(y, x, x < width / 2 ? 0 : 1) = 1;
    const Scene scene = scene_of_picture(picture, map);
    ASSERT_EQ(scene.meshes.size(), 2u);
    const Mesh& behind = scene.meshes[1];
    const auto [low, high] = bounds_of(behind);
    EXPECT_NEAR(low.x, 0, 1e-9);
    EXPECT_NEAR(high.x, 1.0 / 12, 1e-9);
    EXPECT_NEAR(high.y - low.y, static_cast<double>(height) / width, 1e-9);
    EXPECT_NEAR(low.z, 0, 1e-9);
    EXPECT_NEAR(high.z, 0, 1e-9);
    for (const Rgb& color : behind.radiance) EXPECT_EQ(color, (Rgb{1, 0, 0}));
}

TEST(DepthMaps, are_read_coarsely_without_values_between_surfaces) {
    const auto map =
        map_of(2400, 1200, [](std::size_t x, std::size_t y) { return (x / 400 + y / 300) % 2 ? 1.0f : 0.0f; });
    const Scene scene = scene_of_picture(grey(24, 12), map);
    EXPECT_LE(scene.meshes[0].triangles.size(), std::size_t{1} << 21);
    EXPECT_GT(scene.meshes[0].triangles.size(), (std::size_t{1} << 21) * 99 / 100);
    for (const Vec3& p : scene.meshes[0].positions) ASSERT_TRUE(p.z == 0 || p.z == 0.25) << p.z;
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_NE(scene.notes[0].find("the map is read at 1448x724"), std::string::npos) << scene.notes[0];
}

TEST(DepthMaps, are_refused_if_they_do_not_suit) {
    const auto map = map_of(4, 3, [](std::size_t x, auto) { return static_cast<float>(x); });
    const Image picture = grey(4, 3);
    EXPECT_EQ(core::code_of([&] { scene_of_picture(grey(4, 4), map); }), ErrorCode::bad_input);
    EXPECT_EQ(core::code_of([&] { scene_of_picture(picture, View<const float, 2>()); }), ErrorCode::bad_input);
    EXPECT_EQ(core::code_of([&] { scene_of_picture(Image()); }), ErrorCode::bad_input);
    DepthMapOptions options;
    options.near = 0;
    EXPECT_EQ(core::code_of([&] { scene_of_picture(picture, map, options); }), ErrorCode::usage);
    options.far = 0;
    EXPECT_EQ(core::code_of([&] { scene_of_picture(picture, map, options); }), ErrorCode::usage);
    options = {};
    options.values = DepthValues::disparity;
    EXPECT_EQ(core::code_of([&] { scene_of_picture(picture, map, options); }), ErrorCode::usage);
    options.near = -0.4;
    options.far = 0;
    EXPECT_EQ(core::code_of([&] { scene_of_picture(picture, map, options); }), ErrorCode::usage);
}

}  // namespace
}  // namespace hogel::scene
