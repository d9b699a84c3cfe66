// SPDX-License-Identifier: Apache-2.0
// glTF files that announce missing contents. Most of these used to be accepted silently.
#include <tuple>
#include <vector>

#include "hogel/scene/mesh_files/import_fixture.h"

namespace hogel::scene::mesh_files {
namespace {

/// Two triangles of four vertices by 16-bit indices, with texture coordinates.
std::string quad() {
    const std::string bytes = raw<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) + raw<float>({0, 0, 1, 0, 1, 1, 0, 1}) +
                              raw<std::uint16_t>({0, 1, 2, 0, 2, 3});
    return fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}},
{{"bufferView":2,"byteOffset":0,"componentType":5123,"count":6,"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},
{{"buffer":0,"byteOffset":80,"byteLength":12}}],
"buffers":[{{"byteLength":92,"uri":"data:application/octet-stream;base64,{}"}}]}})",
                       base64(bytes));
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    return text.replace(at, what.size(), with);
}

using Gltf = Import;

TEST_F(Gltf, what_is_whole_is_read) {
    const Scene scene = import_scene(write("quad.gltf", quad()));
    EXPECT_EQ(triangle_count(scene), 2u);
    EXPECT_EQ(scene.meshes[0].texture_coordinates.size(), 4u);
}

TEST_F(Gltf, one_wrong_number_is_refused_by_name) {
    const std::string positions = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3")";
    const std::string indices = R"({"bufferView":2,"byteOffset":0,"componentType":5123,"count":6,"type":"SCALAR"})";
    const std::string view = R"({"buffer":0,"byteOffset":80,"byteLength":12})";
    const std::vector<std::tuple<std::string, std::string, std::string>> cases{
        // Offsets and alignment.
        {R"("byteOffset":48)", R"("byteOffset":-48)", "bufferViews[1].byteOffset is -48"},
        {R"("byteOffset":48)", R"("byteOffset":46)", "accessors[1].byteOffset"},
        {R"("byteOffset":48)", R"("byteOffset":18446744073709551568)", "bufferViews[1].byteOffset"},
        {indices, replaced(indices, R"("byteOffset":0)", R"("byteOffset":1)"), "multiples of 2"},
        {indices, replaced(indices, R"("byteOffset":0)", R"("byteOffset":2)"), "in the 12 bytes of its view"},
        {indices, replaced(indices, R"("byteOffset":0)", R"("byteOffset":-2)"), "accessors[2].byteOffset is -2"},
        {R"("byteOffset":48,)", R"("byteOffset":48,"byteStride":0,)", "byteStride is 0"},
        {R"("byteOffset":48,)", R"("byteOffset":48,"byteStride":4,)", "every 4 bytes"},
        // Sizes.
        {view, R"({"buffer":0,"byteOffset":80,"byteLength":13})", "bytes 80 to 93 of a buffer"},
        {view, R"({"buffer":1,"byteOffset":80,"byteLength":12})", "bufferViews[2].buffer is 1"},
        {view, R"({"buffer":0,"byteOffset":80})", "bufferViews[2].byteLength missing"},
        {R"("byteLength":92)", R"("byteLength":93)", "buffers[0].byteLength is 93"},
        {positions, replaced(positions, R"("count":4)", R"("count":5)"), "has 5 elements of 12 bytes"},
        {positions, replaced(positions, R"("count":4)", R"("count":4294967295)"), "accessors[0]"},
        {positions, replaced(positions, R"("count":4)", R"("count":4.0)"), "accessors[0].count is 4.0"},
        {positions, replaced(positions, R"("count":4)", R"("count":3)"), "TEXCOORD_0 has 4 elements; expected 3"},
        {positions, replaced(positions, "5126", "5127"), "accessors[0].componentType is 5127"},
        {positions, replaced(positions, "VEC3", "VEC5"), "accessors[0].type"},
        // References.
        {R"("indices":2)", R"("indices":3)", "indices is 3; expected the number of one of 3 accessors"},
        {R"("indices":2)", R"("indices":0)", "not indices"},
        {R"("indices":2)", R"("indices":2,"mode":7)", "mode is 7"},
        {R"("mesh":0)", R"("mesh":-1)", "nodes[0].mesh is -1"},
        {"TEXCOORD_0", "TEXCOORD_4000000000", "TEXCOORD_4000000000 skips numbers"},
        {"TEXCOORD_0", "TEXCOORD_-1", "TEXCOORD_-1 skips numbers"},
        {R"("scene":0)", R"("scene":1)", "scene is 1"},
        // What cannot be read at all.
        {R"("asset")", R"("extensionsRequired":["KHR_texture_basisu"],"asset")", "KHR_texture_basisu"},
        {R"("version":"2.0")", R"("version":"3.0")", "asset.version is \"3.0\""},
        {R"("version":"2.0")", R"("version":"2.1","minVersion":"2.1")", "asset.minVersion is \"2.1\""},
        {R"("scene":0)", R"("scene":0,"scene":0)", "the key \"scene\" occurs twice"},
        {R"("scene":0)", R"("scene":1e999)", "number out of range"},
        {R"("scene":0)", R"("scene":)", "error at byte"},
        {"base64,", "base64,?", "not base64"},
    };
    for (const auto& [what, with, words] : cases) expect_refusal("wrong.gltf", replaced(quad(), what, with), words);
}

TEST_F(Gltf, indices_of_vertices_that_do_not_exist_are_refused) {
    for (const std::uint16_t wrong : {4, 65535}) {
        const std::string whole = raw<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
                                  raw<float>({0, 0, 1, 0, 1, 1, 0, 1}) + raw<std::uint16_t>({0, 1, 2, 0, 2, wrong});
        std::string text = quad();
        const std::size_t at = text.find("base64,") + 7;
        text.replace(at, text.find('"', at) - at, base64(whole));
        expect_refusal("index.gltf", text, fmt::format("has the vertex index {}; expected less than 4", wrong));
    }
}

TEST_F(Gltf, extensions_of_looks_may_be_required) {
    const std::string names = R"(["KHR_materials_unlit","KHR_materials_clearcoat"])";
    const std::string text =
        replaced(quad(), R"("asset")", fmt::format(R"("extensionsRequired":{0},"extensionsUsed":{0},"asset")", names));
    EXPECT_EQ(triangle_count(import_scene(write("looks.gltf", text))), 2u);
}

TEST_F(Gltf, sparse_elements_lie_in_their_accessor) {
    const auto sparse = [](const std::string& indices, int count) {
        const std::string bytes = raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + indices + raw<float>({0, 2, 0, 0, 3, 0});
        return fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{{"count":{},
"indices":{{"bufferView":1,"componentType":5123}},"values":{{"bufferView":2}}}}}}],
"bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":4}},
{{"buffer":0,"byteOffset":40,"byteLength":24}}],
"buffers":[{{"byteLength":64,"uri":"data:;base64,{}"}}]}})",
                           count, base64(bytes));
    };
    const Scene scene = import_scene(write("sparse.gltf", sparse(raw<std::uint16_t>({2, 0}), 1)));
    EXPECT_EQ(bounds(scene).high.y, 2);
    expect_refusal("beyond.gltf", sparse(raw<std::uint16_t>({3, 0}), 1), "has element 3 at place 0");
    expect_refusal("order.gltf", sparse(raw<std::uint16_t>({2, 1}), 2), "has element 1 at place 1");
    expect_refusal("count.gltf", sparse(raw<std::uint16_t>({0, 1}), 4), "sparse.count is 4");
}

TEST_F(Gltf, a_name_with_percent_signs_means_the_file_without) {
    const fs::path path = write("my buf.bin", raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(36, '\1'));
    std::string text = gltf(R"([{"mesh":0}])", "[0]");
    const std::size_t at = text.find("data:application");
    text.replace(at, text.find('"', at) - at, "my%20buf.bin");
    EXPECT_EQ(triangle_count(import_scene(write("percent.gltf", text))), 1u);
    fs::remove(path);
    expect_refusal("percent.gltf", text, "'my%20buf.bin' not found");
}

// assimp 5.2 crashes on the first, though glTF does not ask for inverse bind matrices.
TEST_F(Gltf, skins_and_animations_do_not_matter) {
    std::string text = replaced(quad(), R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0,"skin":0},{"name":"joint"}])");
    text = replaced(text, R"("asset")", R"("skins":[{"joints":[1]}],"asset")");
    EXPECT_EQ(triangle_count(import_scene(write("skin.gltf", text))), 2u);
    text = replaced(text, R"("asset")", R"("animations":[{"samplers":[{"input":99}],"channels":[]}],"asset")");
    EXPECT_EQ(triangle_count(import_scene(write("animation.gltf", text))), 2u);
}

TEST_F(Gltf, json_nests_only_so_deep) {
    expect_refusal("deep.gltf", std::string(200000, '['), "nests deeper than");
    const std::string extras = std::string(5000, '[') + std::string(5000, ']');
    expect_refusal("extras.gltf", replaced(quad(), R"("asset")", "\"extras\":" + extras + ",\"asset\""),
                   "nests deeper");
}

// assimp recognises these as glTF under any name.
TEST_F(Gltf, other_names_are_checked_as_well) {
    expect_refusal("deep.unknown", std::string(1, '{') + "\"a\":" + std::string(200000, '['), "nests deeper than");
    expect_refusal("index.unknown", replaced(quad(), R"("indices":2)", R"("indices":3)"), "indices is 3");
}

}  // namespace
}  // namespace hogel::scene::mesh_files
