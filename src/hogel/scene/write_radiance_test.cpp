// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "hogel/error.h"
#include "hogel/scene/shapes.h"

namespace hogel::scene {
namespace {

struct Folder {
    Folder() { std::filesystem::create_directory(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("hogel_radiance_" + std::to_string(std::random_device{}()));
};

Scene two_balls() {
    Scene scene;
    for (int i = 0; i < 2; ++i) {
        MeshBuilder builder;
        add_ball(builder, {0.01 * i, 0.002, -0.003}, 0.004, 9, 5, {1, 1, 1});
        drop_slivers(builder.mesh);
        Mesh& mesh = builder.mesh;
        mesh.name = i == 0 ? "left" : "right";
        for (std::size_t k = 0; k < mesh.positions.size(); ++k)
            mesh.radiance.push_back({float(k), 0.001f * float(k), 12.5f});  // far above white
        if (i == 1) {
            auto image = std::make_shared<Image>(3, 2, 3);
            for (std::size_t k = 0; k < 18; ++k) image->pixels.data()[k] = float(k) / 17;
            mesh.material.base_color_texture = image;
            for (std::size_t k = 0; k < mesh.positions.size(); ++k)
                mesh.texture_coordinates.push_back({0.1f * float(k), 0.05f * float(k)});
        }
        scene.meshes.push_back(mesh);
    }
    add_missing_normals(scene, 2);
    return scene;
}

TEST(WriteBakedScene, is_read_back_unchanged) {
    const Folder folder;
    const Scene scene = two_balls();
    write_baked_scene(folder.path / "x.glb", scene);
    const Scene back = import_scene(folder.path / "x.glb");
    ASSERT_EQ(back.meshes.size(), 2u);
    for (std::size_t m = 0; m < 2; ++m) {
        const Mesh &a = scene.meshes[m], &b = back.meshes[m];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.triangles, b.triangles);
        ASSERT_EQ(a.positions.size(), b.positions.size());
        ASSERT_EQ(b.radiance.size(), a.radiance.size());
        for (std::size_t i = 0; i < a.positions.size(); ++i) {
            EXPECT_NEAR(length(a.positions[i] - b.positions[i]), 0, 1e-9);
            EXPECT_NEAR(length(a.normals[i] - b.normals[i]), 0, 1e-6);
            EXPECT_EQ(a.radiance[i], b.radiance[i]);
        }
        EXPECT_EQ(b.material.base_color_texture != nullptr, m == 1);
    }
    for (std::size_t i = 0; i < scene.meshes[1].positions.size(); ++i) {
        EXPECT_NEAR(scene.meshes[1].texture_coordinates[i].v, back.meshes[1].texture_coordinates[i].v, 1e-6);
        EXPECT_NEAR(scene.meshes[1].texture_coordinates[i].u, back.meshes[1].texture_coordinates[i].u, 1e-6);
    }
    EXPECT_NEAR(back.meshes[1].material.base_color_texture->pixels(1, 1, 2), 14.0 / 17, 0.01);
}

TEST(WriteBakedScene, keeps_what_made_it) {
    const Folder folder;
    Scene scene = two_balls();
    scene.name = "balls";
    scene.provenance = {{"command", "make balls"}, {"option size", "4"}, {"scene", "ball"}};
    write_baked_scene(folder.path / "x.glb", scene, {{"command", "bake"}, {"option rays", "\"9\" µ"}});
    const Metadata expected{{"command", "bake"},         {"option rays", "\"9\" µ"},
                            {"scene", "balls"},          {"source command", "make balls"},
                            {"source option size", "4"}, {"source scene", "ball"}};
    EXPECT_EQ(import_scene(folder.path / "x.glb").provenance, expected);
}

// Whatever others keep under this name is passed over, but for texts.
TEST(WriteBakedScene, provenance_of_others_is_passed_over) {
    const Folder folder;
    Scene scene = two_balls();
    scene.name = "test";
    write_baked_scene(folder.path / "x.glb", scene, {{"command", "bake"}});
    std::ifstream file(folder.path / "x.glb", std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(file), {});
    const std::string ours = R"("hogel":{"command":"bake","scene":"test"})";
    ASSERT_NE(whole.find(ours), whole.npos);
    for (std::string theirs : {R"("hogel":[1,"x"])", R"("hogel":{"a":1,"b":"c"})", R"("hogel":"x")"}) {
        const bool has_text = theirs.find("\"c\"") != theirs.npos;
        theirs.resize(ours.size(), ' ');
        std::string changed = whole;
        changed.replace(changed.find(ours), ours.size(), theirs);
        std::ofstream(folder.path / "y.glb", std::ios::binary) << changed;
        const Metadata expected = has_text ? Metadata{{"b", "c"}} : Metadata{};
        EXPECT_EQ(import_scene(folder.path / "y.glb").provenance, expected);
    }
}

TEST(WriteBakedScene, gives_the_same_bytes_every_time) {
    const Folder folder;
    const auto bytes = [&](const char* name) {
        write_baked_scene(folder.path / name, two_balls());
        std::ifstream file(folder.path / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    EXPECT_EQ(bytes("a.glb"), bytes("b.glb"));
}

// Truncated files and files with a flipped bit are refused with a one-line message or read as another scene, but never
// crash.
TEST(WriteBakedScene, damaged_files_are_refused_or_read) {
    const Folder folder;
    const std::filesystem::path path = folder.path / "x.glb";
    write_baked_scene(path, two_balls());
    std::ifstream file(path, std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(file), {});
    std::mt19937 random(4);
    int refused = 0;
    for (int i = 0; i < 300; ++i) {
        std::string bytes = whole;
        if (i % 2 == 0)
            bytes.resize(random() % bytes.size());
        else
            bytes[random() % (i % 4 == 1 ? 2000 : bytes.size())] ^= char(1 << random() % 8);
        std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
        try {
            import_scene(path);
        } catch (const Error& error) {
            ++refused;
            ASSERT_EQ(error.code(), ErrorCode::bad_input) << error.what();
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(WriteBakedScene, refuses_scenes_without_radiance_and_other_names) {
    const Folder folder;
    Scene scene = two_balls();
    EXPECT_THROW(write_baked_scene(folder.path / "x.ply", scene), Error);
    EXPECT_THROW(write_baked_scene(folder.path / "no" / "x.glb", scene), Error);
    scene.meshes[1].radiance.clear();
    EXPECT_THROW(write_baked_scene(folder.path / "x.glb", scene), Error);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

}  // namespace
}  // namespace hogel::scene
