// SPDX-License-Identifier: Apache-2.0
// glTF files that are packed by KHR_draco_mesh_compression: what libdraco packs comes back.
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <vector>

#include "hogel/scene/mesh_files/import_fixture.h"

namespace hogel::scene::mesh_files {
namespace {

/// A square of four vertices and two triangles, as glTF with the stream in its buffer.
class Draco : public Import {
  protected:
    static std::string stream() {
        draco::Mesh mesh;
        mesh.set_num_points(4);
        const auto add = [&](draco::GeometryAttribute::Type kind, draco::DataType type, std::int8_t components,
                             const auto& values) {
            using T = std::decay_t<decltype(values[0])>;
            draco::GeometryAttribute attribute;
            attribute.Init(kind, nullptr, static_cast<std::uint8_t>(components), type, false,
                           components * static_cast<std::int64_t>(sizeof(T)), 0);
            const int id = mesh.AddAttribute(attribute, true, 4);
            for (std::uint32_t i = 0; i < 4; ++i)
                mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                                      &values[i * static_cast<std::size_t>(components)]);
        };
        const std::vector<float> places{0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0};
        const std::vector<std::uint8_t> colors(16, 255);
        add(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, places);
        add(draco::GeometryAttribute::COLOR, draco::DT_UINT8, 4, colors);
        mesh.AddFace({draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)});
        mesh.AddFace({draco::PointIndex(0), draco::PointIndex(2), draco::PointIndex(3)});
        draco::ExpertEncoder encoder(mesh);
        encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);  // keeps the order of vertices
        draco::EncoderBuffer buffer;
        EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
        return {buffer.data(), buffer.size()};
    }

    static std::string gltf_of(const std::string& packed, int vertices = 4, int indices = 6, int color_id = 1) {
        return fmt::format(
            R"({{"asset":{{"version":"2.0"}},"extensionsUsed":["KHR_draco_mesh_compression"],
"extensionsRequired":["KHR_draco_mesh_compression"],"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"COLOR_0":1}},"indices":2,"extensions":
{{"KHR_draco_mesh_compression":{{"bufferView":0,"attributes":{{"POSITION":0,"COLOR_0":{3}}}}}}}}}]}}],
"accessors":[{{"componentType":5126,"count":{1},"type":"VEC3","min":[0,0,0],"max":[1,2,0]}},
{{"componentType":5121,"normalized":true,"count":{1},"type":"VEC4"}},{{"componentType":5123,"count":{2},"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteLength":{4}}}],
"buffers":[{{"byteLength":{4},"uri":"data:application/octet-stream;base64,{0}"}}]}})",
            base64(packed), vertices, indices, color_id, packed.size());
    }
};

TEST_F(Draco, vertices_and_faces_are_those_that_were_packed) {
    const Scene scene = import_scene(write("d.gltf", gltf_of(stream())));
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(bounds(scene).high, (Vec3{1, 2, 0}));
    for (const Vec3 normal : mesh.normals) EXPECT_NEAR(normal.z, 1, 1e-6);
    ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
    EXPECT_EQ(mesh.colors[0], (Rgb{1, 1, 1}));
    EXPECT_TRUE(scene.notes.empty());
}

TEST_F(Draco, what_is_announced_must_be_packed) {
    const std::string whole = stream();
    expect_refusal("more.gltf", gltf_of(whole, 5), "holds other numbers of vertices");
    expect_refusal("faces.gltf", gltf_of(whole, 4, 9), "holds other numbers of vertices and indices");
    expect_refusal("many.gltf", gltf_of(whole, 2000000000), "and those before it announce");
    expect_refusal("id.gltf", gltf_of(whole, 4, 6, 7), "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression");
    for (std::size_t kept = 1; kept < whole.size(); kept += 7) {
        const std::string message = refusal(write("cut.gltf", gltf_of(whole.substr(0, kept))));
        EXPECT_NE(message.find("damaged"), std::string::npos) << message;
    }
}

// Every byte is wrong once; whatever libdraco makes of it, the import ends with a scene or a line.
TEST_F(Draco, damaged_streams_end_in_a_line) {
    const std::string whole = stream();
    for (std::size_t i = 0; i < whole.size(); i += 5) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0xA5);
        try {
            import_scene(write("damaged.gltf", gltf_of(damaged)));
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input) << error.what();
        }
    }
}

}  // namespace
}  // namespace hogel::scene::mesh_files
