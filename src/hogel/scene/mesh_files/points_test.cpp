// SPDX-License-Identifier: Apache-2.0
// Point clouds become discs that close the surface.
#include "hogel/scene/mesh_files/points.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "hogel/scene/mesh_files/import_fixture.h"
#include "hogel/scene/mesh_files/read_ply.h"

namespace hogel::scene::mesh_files {
namespace {

std::vector<Vec3> random_sphere(std::size_t count) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p{normal(random), normal(random), normal(random)};
        points.push_back(Vec3{3, 0, 0} + 2 * normalize(p));
    }
    return points;
}

// Whether the line from the middle of the sphere through a point meets a triangle of the mesh.
bool is_covered(const Mesh& mesh, Vec3 direction) {
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 p = mesh.positions[a] - Vec3{3, 0, 0}, q = mesh.positions[b] - Vec3{3, 0, 0},
                   r = mesh.positions[c] - Vec3{3, 0, 0};
        if (dot(p, direction) < 0) continue;
        const double u = dot(direction, cross(p, q)), v = dot(direction, cross(q, r)), w = dot(direction, cross(r, p));
        if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) return true;
    }
    return false;
}

double covered_share(const Mesh& mesh) {
    std::size_t covered = 0;
    const std::vector<Vec3> directions = random_sphere(900);
    for (std::size_t i = 0; i < 400; ++i) covered += is_covered(mesh, directions[500 + i] - Vec3{3, 0, 0}) ? 1 : 0;
    return static_cast<double>(covered) / 400;
}

TEST(Discs, close_a_surface_of_random_points_and_smaller_ones_do_not) {
    const Points points{random_sphere(600), {}, {}};
    EXPECT_GE(covered_share(discs(points, 1)), 0.99);
    EXPECT_LT(covered_share(discs(points, 0.4)), 0.8);
}

TEST(Discs, face_outwards_without_normals_and_as_given_with_them) {
    const std::vector<Vec3> sphere = random_sphere(600);
    const Mesh mesh = discs({sphere, {}, {}}, 1);
    ASSERT_EQ(mesh.triangles.size(), 4 * sphere.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3 outwards = normalize(sphere[i / 6] - Vec3{3, 0, 0});
        EXPECT_GT(dot(mesh.normals[i], outwards), 0.8);
        EXPECT_NEAR(dot(mesh.positions[i] - sphere[i / 6], mesh.normals[i]), 0, 1e-9);  // in the disc's plane
    }
    for (const auto& [a, b, c] : mesh.triangles) {  // and the corners run counterclockwise from outside
        const Vec3 p = mesh.positions[a];
        EXPECT_GT(dot(cross(mesh.positions[b] - p, mesh.positions[c] - p), mesh.normals[a]), 0);
    }
    const Mesh given = discs({sphere, std::vector<Vec3>(sphere.size(), Vec3{0, 1, 0}), {}}, 1);
    for (const Vec3& normal : given.normals) EXPECT_EQ(normal, (Vec3{0, 1, 0}));
}

TEST(Discs, of_a_square_lattice_leave_no_gap) {
    Points points;
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) points.positions.push_back({x * 1e-3, y * 1e-3, 0});
    const Mesh mesh = discs(points, 1);
    // The middle of a cell is at 0.71 spacings from its corners.
    const double radius = length(mesh.positions[6 * 40] - points.positions[40]);
    EXPECT_GE(radius * std::cos(std::numbers::pi / 6), 1e-3 * std::sqrt(0.5));
    EXPECT_LE(radius, 1.6e-3);
}

TEST(Discs, are_found_in_clouds_of_any_shape) {
    Points line, outlier;
    for (int i = 0; i < 2000; ++i) line.positions.push_back({1e-3 * i, 0, 0});
    outlier.positions = random_sphere(2000);
    outlier.positions.push_back({1e9, 0, 0});
    EXPECT_EQ(discs(line, 1).positions.size(), 6u * 2000);
    const Mesh mesh = discs(outlier, 1);
    ASSERT_EQ(mesh.positions.size(), 6u * 2001);
    EXPECT_LT(length(mesh.positions[0] - outlier.positions[0]), 0.5);
    EXPECT_TRUE(discs({std::vector<Vec3>(50, Vec3{1, 2, 3}), {}, {}}, 1).triangles.empty());  // one point, fifty times
}

using PointFiles = Import;
const std::string header =
    "element vertex 4\nproperty float x\nproperty float y\nproperty double z\n" + ply_colors + "end_header\n";

TEST_F(PointFiles, of_ply_are_read_as_text_and_as_bytes_of_either_order) {
    std::string little = "ply\nformat binary_little_endian 1.0\n" + header;
    std::string big = "ply\nformat binary_big_endian 1.0\n" + header;
    std::string text = "ply\nformat ascii 1.0\n" + header;
    for (int i = 0; i < 4; ++i) {
        const auto x = static_cast<float>(i % 2), y = static_cast<float>(i / 2);
        const double z = 0.25 * i;
        const std::string bytes[]{raw<float>({x}), raw<float>({y}), raw<double>({z})};
        for (const std::string& value : bytes) {
            little += value;
            big.append(value.rbegin(), value.rend());
        }
        const std::string colour{static_cast<char>(255), static_cast<char>(0), static_cast<char>(128)};
        little += colour;
        big += colour;
        text += fmt::format("{} {} {} 255 0 128\n", x, y, z);
    }
    for (const std::string& bytes : {little, big, text}) {
        const auto points = read_ply("x.ply", bytes).points;
        ASSERT_TRUE(points);
        ASSERT_EQ(points->positions.size(), 4u);
        EXPECT_EQ(points->positions[3], (Vec3{1, 1, 0.75}));
        EXPECT_EQ(points->colors[2].r, 1);
        EXPECT_EQ(points->colors[2].g, 0);
        EXPECT_NEAR(points->colors[2].b, 0.2159, 1e-3);  // display value 128
        EXPECT_EQ(import_scene(write("p.ply", bytes)).meshes[0].name, "points");
        for (std::size_t kept = 0; kept + 6 < bytes.size(); ++kept)
            refusal(write("cut.ply", bytes.substr(0, kept + 1)));
    }
}

TEST_F(PointFiles, as_text_have_coordinates_and_a_colour_or_a_normal) {
    const Points bare = read_xyz("x.xyz", "3\n# comment\n0 0 0\n1, 0, 0\r\n\n0;1;0 // last\n");
    EXPECT_EQ(bare.positions.size(), 3u);
    EXPECT_EQ(bare.positions[2], (Vec3{0, 1, 0}));
    EXPECT_TRUE(bare.colors.empty());
    const Points bytes = read_xyz("x.xyz", "0 0 0 255 0 51\n1 0 0 255 255 0\n");
    EXPECT_EQ(bytes.colors[0].r, 1);
    EXPECT_NEAR(bytes.colors[0].b, 0.0331, 1e-3);
    const Points shares = read_xyz("x.xyz", "0 0 0 0.5 0.25 0\n1 0 0 1.0 0.5 0.5\n");
    EXPECT_NEAR(shares.colors[0].r, 0.2140, 1e-3);
    const Points intensity = read_xyz("x.pts", "0 0 0 17 255 0 0\n1 0 0 -3 0 255 0\n");
    EXPECT_EQ(intensity.colors[1].g, 1);
    const Points normals = read_xyz("x.xyz", "0 0 0 0 0 1\n1 0 0 0.6 0 0.8\n");
    EXPECT_TRUE(normals.colors.empty());
    EXPECT_NEAR(normals.normals[1].x, 0.6, 1e-12);
    expect_refusal("a.xyz", "0 0 0\n1 2 x\n", "line 2 has 'x'");
    expect_refusal("b.xyz", "0 0 0\n1 2\n", "line 2 has 2 numbers");
    expect_refusal("c.xyz", "# nothing\n", "no points");
    expect_refusal("d.xyz", "0 0 0\n", "no triangles");
    expect_refusal("e.xyz", "0 0 0\n1 nan 0\n", "point 1 not finite");
}

TEST_F(PointFiles, of_gaussian_splats_are_refused_by_that_name) {
    const std::string splats = ply_vertices(1, "property float f_dc_0\n") + "end_header\n0 0 0 1\n";
    const std::string packed =
        "ply\nformat ascii 1.0\nelement chunk 0\nproperty float min_x\nelement vertex 1\n"
        "property uint packed_position\nend_header\n0\n";
    expect_refusal("c.ply", packed, "Gaussian splats");
    expect_refusal("s.ply", splats, "Gaussian splats");
    expect_refusal("s.splat", "0123456789", "Gaussian splats");
}

}  // namespace
}  // namespace hogel::scene::mesh_files
