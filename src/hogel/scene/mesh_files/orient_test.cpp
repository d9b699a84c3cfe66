// SPDX-License-Identifier: Apache-2.0
// Which side of a surface is its front, in files that do not say.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "hogel/core/random.h"
#include "hogel/scene/mesh_files/import_fixture.h"
#include "hogel/scene/mesh_files/orient.h"

namespace hogel::scene::mesh_files {
namespace {

using std::numbers::pi;

/// A ball about a point, its triangles outwards.
Mesh ball(Vec3 center = {}, double radius = 1) {
    constexpr std::uint32_t rows = 12, columns = 24;
    Mesh mesh;
    const auto add = [&](double a, double b) {
        mesh.positions.push_back(center +
                                 radius * Vec3{std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b)});
    };
    add(0, 0);
    for (std::uint32_t i = 1; i < rows; ++i)
        for (std::uint32_t k = 0; k < columns; ++k) add(pi * i / rows, 2 * pi * k / columns);
    add(pi, 0);
    const auto at = [](std::uint32_t i, std::uint32_t k) { return 1 + (i - 1) * columns + k % columns; };
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (std::uint32_t k = 0; k < columns; ++k) {
        mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
        for (std::uint32_t i = 1; i + 1 < rows; ++i) {
            mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
        mesh.triangles.push_back({last, at(rows - 1, k + 1), at(rows - 1, k)});
    }
    return mesh;
}

void turn(Mesh& mesh, std::size_t triangle) { std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]); }

void turn_some(Mesh& mesh, std::uint32_t seed) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (core::philox({t, seed, 0, 0}, {1, 2})[0] & 1) turn(mesh, t);
}

std::size_t inwards(const Mesh& mesh, Vec3 center = {}) {
    std::size_t count = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 p = mesh.positions[a];
        count += dot(cross(mesh.positions[b] - p, mesh.positions[c] - p), p - center) < 0 ? 1 : 0;
    }
    return count;
}

std::string obj(const Mesh& mesh, bool with_normals = false) {
    std::string text;
    for (const Vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    if (with_normals)
        for (const Vec3& p : mesh.positions) text += fmt::format("vn {} {} {}\n", -p.x, -p.y, -p.z);
    for (const auto& [a, b, c] : mesh.triangles)
        text += with_normals ? fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", a + 1, b + 1, c + 1)
                             : fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    return text;
}

TEST(Orient, a_body_faces_outwards_however_its_triangles_were_turned) {
    const Mesh right = ball();
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        Mesh mesh = right;
        turn_some(mesh, seed);
        const std::size_t wrong = inwards(mesh);
        EXPECT_EQ(orient_neighbors(mesh, sorted_edges(mesh)), wrong);
        EXPECT_EQ(mesh.triangles, right.triangles) << seed;
    }
}

TEST(Orient, each_of_several_surfaces_is_turned_by_itself) {
    Mesh mesh = ball(), other = ball({5, 0, 0}, 0.5);
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (auto [a, b, c] : other.triangles) mesh.triangles.push_back({base + a, base + b, base + c});
    const Mesh right = mesh;
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
        mesh = right;
        turn_some(mesh, seed);
        orient_neighbors(mesh, sorted_edges(mesh));
        EXPECT_EQ(mesh.triangles, right.triangles);
    }
}

// The inner wall of a hollow ball faces inwards, as it must.
TEST(Orient, neighbors_that_agree_stay) {
    Mesh mesh = ball(), inner = ball({}, 0.5);
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), inner.positions.begin(), inner.positions.end());
    for (auto [a, b, c] : inner.triangles) mesh.triangles.push_back({base + a, base + c, base + b});
    const auto before = mesh.triangles;
    EXPECT_EQ(orient_neighbors(mesh, sorted_edges(mesh)), 0u);
    EXPECT_EQ(mesh.triangles, before);
}

TEST(Orient, an_open_sheet_takes_the_side_that_more_of_it_has) {
    Mesh mesh = ball();
    std::erase_if(mesh.triangles, [&](const auto& t) { return mesh.positions[t[0]].y < 0; });
    const auto right = mesh.triangles;
    turn(mesh, 3), turn(mesh, 4), turn(mesh, 40);
    EXPECT_EQ(orient_neighbors(mesh, sorted_edges(mesh)), 3u);
    EXPECT_EQ(mesh.triangles, right);
}

TEST(Orient, a_strip_with_one_side_stays) {
    Mesh mesh;
    constexpr std::uint32_t n = 30;
    for (std::uint32_t i = 0; i < n; ++i)
        for (const double side : {-1.0, 1.0}) {
            const double a = 2 * pi * i / n, half = a / 2, r = 3 + side * std::cos(half);
            mesh.positions.push_back({r * std::cos(a), r * std::sin(a), side * std::sin(half)});
        }
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool last = i + 1 == n;  // its ends are joined upside down
        const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({a, d, c});
    }
    const auto before = mesh.triangles;
    EXPECT_EQ(orient_neighbors(mesh, sorted_edges(mesh)), 0u);
    EXPECT_EQ(mesh.triangles, before);
}

using Fronts = Import;

TEST_F(Fronts, of_files_are_found_and_noted) {
    Mesh mesh = ball();
    turn_some(mesh, 1);
    const Scene scene = import_scene(write("ball.obj", obj(mesh)));
    EXPECT_EQ(inwards(scene.meshes.at(0)), 0u);
    EXPECT_EQ(scene.notes.size(), 1u);
    EXPECT_FALSE(scene.meshes[0].material.double_sided);
    for (const auto& [a, b, c] : scene.meshes[0].triangles)
        EXPECT_GT(dot(scene.meshes[0].normals[a], scene.meshes[0].positions[a]), 0.9);
}

TEST_F(Fronts, of_sheets_are_both_sides) {
    const Scene sheet = import_scene(write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"));
    EXPECT_TRUE(sheet.meshes.at(0).material.double_sided);
    EXPECT_FALSE(import_scene(write("x.gltf", gltf(R"([{"mesh":0}])", "[0]"))).meshes.at(0).material.double_sided);
}

TEST_F(Fronts, normals_that_point_inwards_are_turned_alone) {
    const Mesh right = ball();
    const Scene scene = import_scene(write("ball.obj", obj(right, true)));
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(inwards(mesh), 0u);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) EXPECT_GT(dot(mesh.normals[i], mesh.positions[i]), 0.9);
    EXPECT_EQ(scene.notes.size(), 1u);
}

// STL has a normal for each triangle, which says no more than its corners do, and often less.
TEST_F(Fronts, of_stl_files_are_smooth) {
    const Mesh mesh = ball();
    const auto number = [](auto value) { return std::string(reinterpret_cast<const char*>(&value), sizeof value); };
    std::string bytes(80, ' ');
    bytes += number(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& corners : mesh.triangles) {
        for (const float part : {0.0f, 0.0f, 1.0f}) bytes += number(part);
        for (const std::uint32_t corner : corners)
            for (const double part : {mesh.positions[corner].x, mesh.positions[corner].y, mesh.positions[corner].z})
                bytes += number(static_cast<float>(part));
        bytes += std::string(2, '\0');
    }
    const Scene scene = import_scene(write("ball.stl", bytes));
    const Mesh& read = scene.meshes.at(0);
    ASSERT_EQ(read.normals.size(), read.positions.size());
    for (std::size_t i = 0; i < read.positions.size(); ++i) EXPECT_GT(dot(read.normals[i], read.positions[i]), 0.98);
}

}  // namespace
}  // namespace hogel::scene::mesh_files
