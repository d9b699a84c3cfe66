// SPDX-License-Identifier: Apache-2.0
// Small files that make assimp 5.2 crash, or ask for gigabytes.
#include <sys/resource.h>

#include <cmath>
#include <stop_token>
#include <vector>

#include "hogel/scene/mesh_files/import_fixture.h"
#include "hogel/scene/mesh_files/limits.h"
#include "hogel/scene/mesh_files/obj.h"
#include "hogel/work/parallel.h"

namespace hogel::scene::mesh_files {
namespace {

using Hostile = Import;

TEST_F(Hostile, a_root_named_a_thousand_times_is_refused) {
    std::string roots = "[0";
    for (int i = 1; i < 3000; ++i) roots += ",0";
    expect_refusal("roots.gltf", gltf(R"([{"mesh":0}])", roots + "]"), "names node 0 twice");
}

// 20,000 triangles 5,000 times, in 1.1 MB: 3.6 GB once copied.
TEST_F(Hostile, copies_of_a_mesh_are_counted_before_they_are_made) {
    std::string nodes = R"([{"mesh":0})", roots = "[0";
    for (int i = 1; i < 5000; ++i) {
        nodes += R"(,{"mesh":0})";
        roots += fmt::format(",{}", i);
    }
    std::string positions;
    for (int i = 0; i < 60000; ++i)
        positions += raw<float>({static_cast<float>(i), static_cast<float>(i * (i % 3)), 0});
    std::ofstream(folder_ / "meshes" / "large.bin", std::ios::binary) << positions;
    const std::string text = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":{}]}}],"nodes":{}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":60000,"type":"VEC3"}}],
"bufferViews":[{{"buffer":0,"byteLength":720000}}],"buffers":[{{"byteLength":720000,"uri":"large.bin"}}]}})",
        roots, nodes);
    expect_refusal("copies.gltf", text, "the copies of its meshes need more than");
}

TEST_F(Hostile, lists_in_ply_text_have_their_values) {
    const auto ply = [](const std::string& face) {
        return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n" +
               face + "\n";
    };
    EXPECT_EQ(triangle_count(import_scene(write("good.ply", ply("3 0 1 2")))), 1u);
    expect_refusal("list.ply", ply("300000000 0 1 2"), "element 'face' 0: list length '300000000'");
    expect_refusal("list.ply", ply("-1 0 1 2"), "list length '-1'");
    expect_refusal("list.ply", ply("4 0 1 2"), "element 'face' 0: ends early");
    expect_refusal("list.ply", ply(""), "0 lines of data for element 'face'");
}

TEST_F(Hostile, off_counts_are_not_believed) {
    expect_refusal("vertices.off", "OFF\n100000000 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                   "announces 100000000 vertices");
    expect_refusal("faces.off", "OFF\n3 50000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "and 50000000 faces");
    expect_refusal("few.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "has 1 faces; expected 2");
    expect_refusal("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6 has the vertex index 3");
    expect_refusal("minus.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 6 has '-1'");
    expect_refusal("corners.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n900000000 0 1 2\n", "line 6 ends early");
    expect_refusal("short.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 4 ends early");
    expect_refusal("binary.off", "OFF BINARY\n", "BINARY");
    expect_refusal("dimensions.off", "nOFF\n4000000000\n3 1 0\n", "dimensions");
    // assimp takes any text in which it sees "off" for such a file.
    expect_refusal("off.unknown", "# off\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "");
}

TEST_F(Hostile, off_files_are_read_with_all_that_they_hold) {
    const Scene scene = import_scene(write("all.off",
                                           "# a square\nSTCNOFF # with everything\n4 2 0\n\n"
                                           "0 0 0  0 0 2  255 0 0 255  0 0\n1 0 0  0 0 2  0 255 0 255  1 0\n"
                                           "1 1 0  0 0 2  0 0 255 255  1 1\n+0 1 0  0 0 2  255 255 255 255  0 1\n"
                                           "4 0 1 2 3  200 0 0\n2 0 1\n"));
    ASSERT_EQ(triangle_count(scene), 2u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.normals[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(mesh.colors[1], (Rgb{0, 1, 0}));
    EXPECT_EQ(mesh.texture_coordinates[2].u, 1);
    std::string polygon = "4OFF\n12 1\n", face = "12";
    for (int i = 0; i < 12; ++i) {
        polygon += fmt::format("{} {} 0 2\n", 2 * std::cos(i * 0.5236), 2 * std::sin(i * 0.5236));
        face += fmt::format(" {}", i);
    }
    const Scene disc = import_scene(write("disc.off", polygon + face + "\n"));
    EXPECT_EQ(triangle_count(disc), 10u);
    EXPECT_NEAR(bounds(disc).high.x, 1, 1e-6);
    EXPECT_EQ(triangle_count(import_scene(write("bare.off", "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2"))), 1u);
}

// The parser searched all objects of an array again after each of them: 24 s for half as many of these.
TEST_F(Hostile, many_objects_in_one_array_take_linear_time) {
    std::string extras = R"("extras":[{})";
    for (int i = 1; i < 640000; ++i) extras += ",{}";
    std::string text = gltf(R"([{"mesh":0}])", "[0]");
    EXPECT_EQ(triangle_count(import_scene(write("extras.gltf", text.insert(1, extras + "],")))), 1u);
}

// The start of the line was searched from each number on.
TEST(HostileObj, bare_points_in_one_line_take_linear_time) {
    constexpr std::size_t count = 4 << 20;
    std::string text = "v";
    for (std::size_t i = 0; i < count; ++i) text += " .5";
    EXPECT_EQ(with_leading_zeros(text).size(), text.size() + count);
}

TEST(HostileObj, bare_points_get_zeros_in_vertices_alone) {
    EXPECT_EQ(with_leading_zeros(" v .5 -.5 1.5 +.25\nvt .1 .\n# .5\nmtllib .5\nvn 0 .5"),
              " v 0.5 -0.5 1.5 +0.25\nvt 0.1 .\n# .5\nmtllib .5\nvn 0 0.5");
    EXPECT_EQ(with_leading_zeros("v .5"), "v 0.5");
    EXPECT_EQ(with_leading_zeros(""), "");
    EXPECT_EQ(with_leading_zeros("v 1 2 3\n"), "v 1 2 3\n");
}

// Each of them was a copy.
TEST_F(Hostile, parts_that_share_bytes_are_counted) {
    std::string images = R"("images":[)";
    for (int i = 0; i < 40; ++i) images += fmt::format(R"({}{{"bufferView":0}})", i > 0 ? "," : "");
    std::string text = gltf(R"([{"mesh":0}])", "[0]");
    expect_refusal("pictures.gltf", text.insert(1, images + "],"), "images[32] and those before it have 1188 bytes");
    std::string accessors;
    for (int i = 0; i < 400; ++i)
        accessors += R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":3,)"
                     R"("indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}},)";
    text = gltf(R"([{"mesh":0}])", "[0]");
    const std::string numbers = base64(std::string("\0\1\2\0", 4) + std::string(68, '\0'));
    const std::size_t data = text.find("base64,") + 7;
    text.replace(data, text.find('"', data) - data, numbers);
    text.replace(text.find(R"("byteOffset":36,)"), 16, R"("byteOffset":0,)");
    const std::size_t list = text.find(R"("accessors":[)") + 13;
    expect_refusal("sparse.gltf", text.insert(list, accessors), "accessors[384].sparse and those before it replace");
}

// A video with content and a texture, connected: assimp 5.2 frees the content twice.
TEST_F(Hostile, a_crash_of_the_reader_is_one_line) {
    expect_refusal(
        "twice.fbx",
        R"(FBXHeaderExtension:{B:FBXVersion:7500{n:}}s:{s:{P:""}}s:{t:""{0:{P:""}}}s:{n:{e:{0:{}}}}Objects:)"
        R"({y:5{s:{s:}l:{P:""}}V:2957776707120,"",""{0:{P:""}p:Content:"AHS+3dHR0hurq6ofq6ur/j4+P8I+Pj4bq6uo)"
        R"(="}T:2957776714320,"",""{0:{P:""}}r:7,""{0:{P:}}}Connections:{C:"",2,0 C:"",2957776707120,)"
        R"(2957776714320})",
        "the mesh reader crashed");
}

// AC3D: each object makes room for what it announces.
TEST_F(Hostile, memory_is_bounded_by_the_size_of_the_file) {
    std::string text =
        "AC3Db\nMATERIAL \"\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 9\n";
    for (int i = 0; i < 9; ++i) text += "OBJECT poly\nnumvert 20000000\n0 0 0\n";
    expect_refusal("room.ac", text, "");
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    EXPECT_LT(static_cast<std::uint64_t>(used.ru_maxrss) * 1024, child_limits(text.size()).memory * 3 / 2);
}

TEST_F(Hostile, many_threads_may_read_at_once) {
    const fs::path good = write("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    work::parallel_for(8, [&](std::size_t) {
        for (int i = 0; i < 10; ++i) EXPECT_EQ(triangle_count(import_scene(good)), 1u);
    });
}

TEST_F(Hostile, a_stop_ends_the_reader) {
    std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 300000; ++i) obj += "f 1 2 3\n";
    const fs::path path = write("long.obj", obj);
    std::stop_source stop;
    stop.request_stop();
    try {
        import_scene(path, Progress(stop.get_token()));
        ADD_FAILURE() << "read to the end";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace hogel::scene::mesh_files
