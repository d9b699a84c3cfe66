// SPDX-License-Identifier: Apache-2.0
// Triangles with the same corners, as scans have them: every renderer shows the same one, whatever their order.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hogel/render/test_renderers.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

const LightFieldGrid grid{4, 3, 1_mm, 15, 12, Perspective{0.3, 0.25}, 3};

struct Face {
    std::array<Vec3, 3> corners;
    Rgb radiance;
};

// Each face is a mesh of its own, with given radiance.
ShadedScene scene_of(const std::vector<Face>& faces, bool fronts_only) {
    Scene scene;
    scene.name = "faces";
    for (const Face& face : faces) {
        Mesh mesh;
        mesh.positions.assign(face.corners.begin(), face.corners.end());
        mesh.radiance.assign(3, face.radiance);
        mesh.triangles = {{0, 1, 2}};
        scene.meshes.push_back(mesh);
    }
    ShadedScene shaded;
    shaded.fronts_only = fronts_only;
    shade_scene_into(scene, {.model = "given"}, shaded);
    return shaded;
}

std::vector<Face> random_faces(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> aside(-4e-3, 4e-3), depth(3e-3, 9e-3);
    std::uniform_real_distribution<float> light(0.1f, 1.0f);
    std::vector<Face> faces;
    for (std::size_t i = 0; i < count; ++i) {
        Face face;
        for (Vec3& p : face.corners) p = {aside(random), aside(random), -depth(random)};
        face.radiance = {light(random), light(random), light(random)};
        faces.push_back(face);
    }
    return faces;
}

// The same corners in another order, by the number of a permutation, in another colour.
Face doubled(const Face& face, int permutation) {
    Face other = face;
    std::array<int, 3> order{0, 1, 2};
    for (int i = 0; i < permutation; ++i) std::ranges::next_permutation(order);
    for (std::size_t k = 0; k < 3; ++k) other.corners[k] = face.corners[std::size_t(order[k])];
    other.radiance = {1 - face.radiance.r, 0.5f * face.radiance.g, 1 - face.radiance.b};
    return other;
}

// Whether the front is seen from the middle of the hologram.
bool shows_front(const Face& face) {
    const auto& [a, b, c] = face.corners;
    return dot(cross(b - a, c - a), a) < 0;
}

// The first of two faces, unless only the second shows its front to the middle of the hologram.
const Face& expected(const Face& first, const Face& second) {
    return !shows_front(first) && shows_front(second) ? second : first;
}

class DoubledFaces : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, DoubledFaces, ::testing::ValuesIn(renderer_names()),
                         [](const auto& parameter) { return test_name(parameter.param); });

TEST_P(DoubledFaces, are_one_whatever_their_order) {
    std::mt19937 random(1);
    for (int permutation = 0; permutation < 6; ++permutation) {
        const std::vector<Face> faces = random_faces(random, 6);
        std::vector<Face> others;
        for (const Face& face : faces) others.push_back(doubled(face, permutation));
        for (const bool first : {true, false}) {
            const std::vector<Face>&one = first ? faces : others, &two = first ? others : faces;
            std::vector<Face> all = one, wanted;
            all.insert(all.end(), two.begin(), two.end());
            all.insert(all.end(), one.begin(), one.end());
            for (std::size_t i = 0; i < one.size(); ++i) wanted.push_back(expected(one[i], two[i]));
            EXPECT_EQ(scene_of(all, false).triangles.size(), faces.size());
            EXPECT_TRUE(same_bytes(render(GetParam(), scene_of(all, false), grid),
                                   render(GetParam(), scene_of(wanted, false), grid)))
                << permutation << first;
        }
    }
}

// If only fronts are shown, both faces of a sheet are kept, one for each side. Doubled fronts become one.
TEST_P(DoubledFaces, of_opposite_windings_both_stay_where_fronts_alone_are_seen) {
    std::mt19937 random(2);
    const std::vector<Face> faces = random_faces(random, 6);
    std::vector<Face> all = faces, fronts, backs;
    for (const Face& face : faces) all.push_back(doubled(face, 1));
    for (const Face& face : faces) all.push_back(doubled(face, 0));
    const ShadedScene both = scene_of(all, true);
    EXPECT_EQ(both.triangles.size(), 2 * faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) fronts.push_back(shows_front(faces[i]) ? faces[i] : all[6 + i]);
    EXPECT_TRUE(same_bytes(render(GetParam(), both, grid), render(GetParam(), scene_of(fronts, false), grid)));
}

}  // namespace
}  // namespace hogel::render
