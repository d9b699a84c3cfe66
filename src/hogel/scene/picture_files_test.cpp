// SPDX-License-Identifier: Apache-2.0
// Depth channels of pictures, and files of layers.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

#include "hogel/core/test_errors.h"
#include "hogel/image/channels.h"
#include "hogel/scene/pictures.h"

namespace hogel::scene {
namespace {

class PictureFiles : public ::testing::Test {
  protected:
    PictureFiles() {
        std::string name = std::filesystem::temp_directory_path() / "hogel_pictures_XXXXXX";
        folder_ = mkdtemp(name.data());
    }
    ~PictureFiles() override { std::filesystem::remove_all(folder_); }

    /// Writes an EXR file of 2 x 1 pixels: channels of value 1 but one of the values 3 and 7.
    std::filesystem::path exr(const std::vector<std::string>& names, const std::string& depth) const {
        image::NamedChannels picture;
        for (const std::string& name : names) {
            picture.channels.emplace_back(name, Array<float, 2>({1, 2}, 1.0f));
            if (name != depth) continue;
            picture.channels.back().second(0, 0) = 3;
            picture.channels.back().second(0, 1) = 7;
        }
        image::write_named_channels(folder_ / "z.exr", picture);
        return folder_ / "z.exr";
    }
    std::filesystem::path layers(const std::string& text) const {
        std::ofstream(folder_ / "a.layers") << text;
        return folder_ / "a.layers";
    }
    ErrorCode refusal_of(const std::string& text) const {
        return core::code_of([&] { import_scene(layers(text)); });
    }

    std::filesystem::path folder_;
};

// Renderers write distances from the camera.
TEST_F(PictureFiles, have_depths_in_a_channel) {
    for (const std::string depth : {"Z", "depth", "View.Depth.Z"}) {
        const Scene scene = import_scene(exr({"R", "G", "B", "Normal.X", depth}, depth));
        ASSERT_EQ(scene.meshes[0].triangles.size(), 4u) << depth;
        const auto z = [&](std::size_t triangle) {
            return scene.meshes[0].positions[scene.meshes[0].triangles[triangle][0]].z;
        };
        EXPECT_GT(z(0), z(2)) << depth;
        ImportOptions reversed;
        reversed.depths.values = DepthValues::nearness;
        EXPECT_EQ(import_scene(folder_ / "z.exr", {}, reversed).units, SceneUnits::picture_widths);
    }
    EXPECT_EQ(triangle_count(import_scene(exr({"R", "G", "B", "A"}, ""))), 2u);
    EXPECT_EQ(triangle_count(import_scene(exr({"R", "G", "B", "Normal.X", "Normal.Y", "Normal.Z"}, ""))), 2u);
}

TEST_F(PictureFiles, without_depths_refuse_them) {
    ImportOptions options;
    options.depths.near = 0;
    options.depths.far = 1;
    EXPECT_EQ(core::code_of([&] { import_scene(exr({"R", "G", "B"}, ""), {}, options); }), ErrorCode::usage);
}

TEST_F(PictureFiles, of_layers_place_each_at_its_depth) {
    exr({"R", "G", "B"}, "");
    const Scene scene = import_scene(layers(R"({"layers": [{"picture": "z.exr", "depth": "-5mm"},
                                                          {"depth": 0.25, "picture": "./Z.EXR"}]})"));
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.units, SceneUnits::depths);
    for (const Vec3& p : scene.meshes[0].positions) EXPECT_DOUBLE_EQ(p.z, 5e-3);
    for (const Vec3& p : scene.meshes[1].positions) EXPECT_DOUBLE_EQ(p.z, -0.25);
}

TEST_F(PictureFiles, of_layers_are_refused_if_malformed) {
    exr({"R", "G", "B"}, "");
    std::filesystem::create_directory(folder_ / "in");
    EXPECT_NO_THROW(import_scene(layers(R"({"layers": [{"picture": "z.exr", "depth": 0}]})")));
    for (const char* text :
         {"", "[]", "{}", R"({"layers": []})", R"({"layers": 1})", R"({"layers": [1]})", R"({"layers": [{}]})",
          R"({"layers": [{"picture": "z.exr"}]})", R"({"layers": [{"depth": 0}]})",
          R"({"layers": [{"picture": 1, "depth": 0}]})", R"({"layers": [{"picture": "z.exr", "depth": null}]})",
          R"({"layers": [{"picture": "z.exr", "depth": "5"}]})", R"({"layers": [{"picture": "z.exr", "depth": 1e7}]})",
          R"({"layers": [{"picture": "none.exr", "depth": 0}]})", R"({"layers": [{"picture": "", "depth": 0}]})",
          R"({"layers": [{"picture": "a.layers", "depth": 0}]})",
          R"({"layers": [{"picture": "z.exr", "depth": 0, "scale": 2}]})",
          R"({"layers": [{"picture": "z.exr", "depth": 0}, {"picture": "z.exr", "depth": "0mm"}]})",
          R"({"layers": [{"picture": "z.exr", "depth": 0}], "more": 1})"})
        EXPECT_EQ(refusal_of(text), ErrorCode::bad_input) << text;
    // Pictures outside the folder are not opened.
    std::filesystem::rename(folder_ / "a.layers", folder_ / "in/a.layers");
    for (const std::string picture : {"../z.exr", (folder_ / "z.exr").c_str()}) {
        std::ofstream(folder_ / "in/a.layers") << R"({"layers": [{"picture": ")" + picture + R"(", "depth": 0}]})";
        EXPECT_EQ(core::code_of([&] { import_scene(folder_ / "in/a.layers"); }), ErrorCode::bad_input) << picture;
    }
}

}  // namespace
}  // namespace hogel::scene
