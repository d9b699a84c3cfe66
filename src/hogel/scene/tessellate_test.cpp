// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/tessellate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "hogel/error.h"
#include "hogel/scene/shapes.h"

namespace hogel::scene {
namespace {

Scene ball() {
    MeshBuilder builder;
    add_ball(builder, {0, 0, 0}, 1, 12, 6, {0.5f, 0.25f, 1});
    drop_slivers(builder.mesh);
    Scene scene;
    scene.meshes.push_back(std::move(builder.mesh));
    add_missing_normals(scene, 2);
    return scene;
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += 0.5 * length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
    return sum;
}

TEST(Tessellate, cuts_triangles_and_keeps_the_surface) {
    const Scene coarse = ball();
    for (const std::size_t n : {1, 2, 3, 6}) {
        const Scene fine = tessellate(coarse, n);
        EXPECT_NO_THROW(validate(fine));
        EXPECT_EQ(triangle_count(fine), n * n * triangle_count(coarse));
        EXPECT_NEAR(area(fine.meshes[0]), area(coarse.meshes[0]), 1e-12);
        for (const auto& [a, b, c] : fine.meshes[0].triangles) {
            const auto& p = fine.meshes[0].positions;
            EXPECT_GT(dot(cross(p[b] - p[a], p[c] - p[a]), p[a] + p[b] + p[c]), 0);  // still faces outwards
        }
        for (const Vec3& normal : fine.meshes[0].normals) EXPECT_NEAR(length(normal), 1, 1e-12);
        for (const Rgb& color : fine.meshes[0].colors) EXPECT_NEAR(color.g, 0.25f, 1e-6);
    }
}

// The number of vertices of a closed surface satisfies Euler's formula.
TEST(Tessellate, shares_vertices_along_edges) {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    scene.meshes.push_back(mesh);
    const Scene fine = tessellate(scene, 5);
    EXPECT_EQ(fine.meshes[0].positions.size(), fine.meshes[0].triangles.size() / 2 + 2);
    std::map<std::array<std::uint32_t, 2>, int> edges;
    for (const auto& t : fine.meshes[0].triangles)
        for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(edges.contains({edge[1], edge[0]}));
    }
}

TEST(Tessellate, refuses_zero_parts) { EXPECT_THROW(tessellate(ball(), 0), Error); }

}  // namespace
}  // namespace hogel::scene
