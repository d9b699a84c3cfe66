// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "hogel/scene/mesh_files/import_fixture.h"

namespace hogel::scene::mesh_files {
namespace {

TEST_F(Import, obj_polygons_become_triangles_of_the_same_area_and_orientation) {
    const Scene scene = import_scene(write("l.obj",
                                           "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
                                           "f 1 2 3 4 5 6\n"));
    EXPECT_EQ(triangle_count(scene), 4u);
    Vec3 area;
    for (const auto& [a, b, c] : scene.meshes[0].triangles) {
        const auto& p = scene.meshes[0].positions;
        const Vec3 twice = cross(p[b] - p[a], p[c] - p[a]);
        EXPECT_GT(twice.z, 0);
        area += 0.5 * twice;
    }
    EXPECT_NEAR(area.z, 3, 1e-6);
    for (const Vec3 normal : scene.meshes[0].normals) EXPECT_NEAR(normal.z, 1, 1e-6);
}

TEST_F(Import, ply_colours_are_converted_from_display_values) {
    const Scene scene = import_scene(write(
        "c.ply", ply_vertices(3, ply_colors) + "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                               "0 0 0 255 0 188\n1 0 0 255 0 188\n0 1 0 255 0 188\n3 0 1 2\n"));
    ASSERT_EQ(scene.meshes[0].colors.size(), 3u);
    EXPECT_NEAR(scene.meshes[0].colors[0].r, 1, 1e-6);
    EXPECT_NEAR(scene.meshes[0].colors[0].g, 0, 1e-6);
    EXPECT_NEAR(scene.meshes[0].colors[0].b, 0.503, 1e-3);
}

TEST_F(Import, gltf_materials_are_glossy_and_others_matt) {
    const auto material = [&](const char* name, const char* json) {
        return import_scene(write(name, gltf(R"([{"mesh":0}])", "[0]", json))).meshes[0].material;
    };
    const Material metal =
        material("m.gltf", R"({"pbrMetallicRoughness":{"metallicFactor":0.75,"roughnessFactor":0.5}})");
    EXPECT_FLOAT_EQ(metal.metallic, 0.75f);
    EXPECT_FLOAT_EQ(metal.roughness, 0.5f);
    EXPECT_FLOAT_EQ(metal.reflectance, 0.04f);
    EXPECT_FLOAT_EQ(material("r.gltf", R"({"pbrMetallicRoughness":{"metallicFactor":7}})").metallic, 1.0f);
    const Scene matt = import_scene(write("matt.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    EXPECT_EQ(matt.meshes[0].material.reflectance, 0.0f);
    EXPECT_EQ(matt.meshes[0].material.metallic, 0.0f);
}

// Closed surfaces with flipped triangles, and unflipped open sheets and rooms.
TEST_F(Import, bodies_that_are_inside_out_are_turned) {
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n";
    const std::string outside = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n", last = "f 4 1 5 8\n",
                      inside = "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\n", inner_last = "f 8 5 1 4\n";
    const auto faces_outwards = [&](const std::string& text) {
        const Scene scene = import_scene(write("box.obj", text));
        const Mesh& mesh = scene.meshes.at(0);
        std::size_t outwards = 0;
        for (const auto& [a, b, c] : mesh.triangles) {
            const Vec3 p = mesh.positions[a], front = cross(mesh.positions[b] - p, mesh.positions[c] - p);
            outwards += dot(front, p - Vec3{0.5, 1, 1.5}) > 0 ? 1 : 0;
            EXPECT_GT(dot(front, mesh.normals[a]), 0);
        }
        EXPECT_TRUE(outwards == 0 || outwards == mesh.triangles.size()) << outwards;
        return std::pair{outwards > 0, scene.notes.size()};
    };
    EXPECT_EQ(faces_outwards(corners + outside + last), (std::pair{true, std::size_t{0}}));
    EXPECT_EQ(faces_outwards(corners + inside + inner_last), (std::pair{true, std::size_t{1}}));
    EXPECT_EQ(faces_outwards(corners + outside), (std::pair{true, std::size_t{0}}));
    EXPECT_EQ(faces_outwards(corners + inside), (std::pair{false, std::size_t{0}}));
    // Normals that the file has point outwards already.
    const std::string normals = "vn 0 0 -1\nvn 0 0 1\nvn 0 -1 0\nvn 1 0 0\nvn 0 1 0\nvn -1 0 0\n";
    EXPECT_EQ(faces_outwards(corners + normals +
                             "f 1//1 2//1 3//1 4//1\nf 8//2 7//2 6//2 5//2\nf 5//3 6//3 2//3 1//3\n"
                             "f 6//4 7//4 3//4 2//4\nf 7//5 8//5 4//5 3//5\nf 8//6 5//6 1//6 4//6\n"),
              (std::pair{true, std::size_t{1}}));
    // Normals that the file has point inwards too.
    EXPECT_EQ(faces_outwards(corners + normals +
                             "f 1//2 2//2 3//2 4//2\nf 8//1 7//1 6//1 5//1\nf 5//5 6//5 2//5 1//5\n"
                             "f 6//6 7//6 3//6 2//6\nf 7//3 8//3 4//3 3//3\nf 8//4 5//4 1//4 4//4\n"),
              (std::pair{true, std::size_t{1}}));
}

TEST_F(Import, gltf_colours_are_linear) {
    const Scene scene = import_scene(write(
        "c.gltf", gltf(R"([{"mesh":0}])", "[0]",
                       R"({"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,1,1]},"emissiveFactor":[0,0.5,0]})")));
    EXPECT_EQ(scene.meshes[0].colors[1], (Rgb{0.5f, 0.25f, 1}));
    EXPECT_EQ(scene.meshes[0].material.base_color, (Rgb{0.25f, 0.5f, 1}));
    EXPECT_EQ(scene.meshes[0].material.emission, (Rgb{0, 0.5f, 0}));
}

TEST_F(Import, node_transforms_are_applied_and_mirrored_instances_keep_their_front) {
    const Scene scene =
        import_scene(write("n.gltf", gltf(R"([{"children":[1,2],"translation":[10,0,0]},{"mesh":0,"scale":[2,3,1]},
                           {"mesh":0,"scale":[-1,1,1],"translation":[0,0,5]}])",
                                          "[0]")));
    ASSERT_EQ(scene.meshes.size(), 2u);
    const Bounds box = bounds(scene);
    EXPECT_NEAR(box.low.x, 9, 1e-6);
    EXPECT_NEAR(box.high.x, 12, 1e-6);
    EXPECT_NEAR(box.high.y, 3, 1e-6);
    EXPECT_NEAR(box.high.z, 5, 1e-6);
    // A triangle that faces z still does after mirroring in x.
    for (const Mesh& mesh : scene.meshes) EXPECT_NEAR(mesh.normals[mesh.triangles[0][0]].z, 1, 1e-6);
}

TEST_F(Import, normals_are_perpendicular_after_uneven_scaling) {
    // A facet with normal (1, 1, 0)/√2, compressed in y by 2, has the normal (1, 2, 0)/√5.
    const std::string bytes =
        raw<float>({1, 0, 0, 0, 1, 0, 0, 1, 1}) +
        raw<float>({0.70710678f, 0.70710678f, 0, 0.70710678f, 0.70710678f, 0, 0.70710678f, 0.70710678f, 0});
    const Scene scene = import_scene(write("s.gltf", fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,
"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"scale":[1,0.5,1]}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
{{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":36}}],
"buffers":[{{"byteLength":72,"uri":"data:application/octet-stream;base64,{}"}}]}})",
                                                                 base64(bytes))));
    EXPECT_NEAR(scene.meshes[0].normals[0].x, 1 / std::sqrt(5), 1e-6);
    EXPECT_NEAR(scene.meshes[0].normals[0].y, 2 / std::sqrt(5), 1e-6);
}

TEST_F(Import, missing_files_folders_and_empty_files_are_refused) {
    EXPECT_NE(refusal(folder_ / "nothing.obj").find("no such file"), std::string::npos);
    EXPECT_NE(refusal(folder_ / "meshes").find("folder"), std::string::npos);
    expect_refusal("empty.obj", "", "empty");
    expect_refusal("words.xyz123", "these are only words\n", "");
}

TEST_F(Import, meshes_without_a_surface_are_refused) {
    expect_refusal("points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n", "no triangles");
    expect_refusal("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n", "no triangles");
    expect_refusal("index.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 9\n", "");
}

TEST_F(Import, coordinates_that_are_not_finite_are_refused) {
    const std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string faces = face_of(3) + raw<std::int32_t>({0, 1, 2}) + face_of(3) + raw<std::int32_t>({0, 1, 3});
    for (const float wrong : {std::nanf(""), INFINITY})
        expect_refusal("nan.ply", header + raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, wrong, 0, 0}) + faces, "not finite");
    EXPECT_EQ(triangle_count(
                  import_scene(write("fine.ply", header + raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0}) + faces))),
              2u);
}

// Sizes in a header that the file does not have; assimp 5.2 crashes on all of these.
TEST_F(Import, ply_headers_are_not_trusted) {
    const std::string start = "ply\nformat binary_little_endian 1.0\n";
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    const std::string face = "property list uchar int vertex_indices\nend_header\n";
    const std::string vertices = raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
    expect_refusal("a.ply", start + "element vertex 3\n" + xyz, "end_header");
    expect_refusal("b.ply", start + "element vertex 4000000000\n" + xyz + "element face 1\n" + face + vertices,
                   "ends in");
    expect_refusal("c.ply", start + "element vertex 3\n" + xyz + "element face 1\n" + face + vertices.substr(0, 20),
                   "ends in element 'vertex'");
    expect_refusal("d.ply",
                   start + "element vertex 3\n" + xyz + "element face 2\n" + face + vertices + "\x03" +
                       raw<std::int32_t>({0, 1, 2}) + "\xff",
                   "ends in element 'face' 1 of 2");
    expect_refusal("e.ply", start + "element vertex -3\n" + xyz + "element face 1\n" + face + vertices, "-3");
    expect_refusal("f.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "element face 2\n" + face +
                       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                   "lines of data");
    expect_refusal("g.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "element face 3\n" + face +
                       "0 0 0\n1 0 0\n0 1 0\n0\n1 0\n2 0 1\n",
                   "no triangles");
    expect_refusal("h.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "element face 1\n" + face +
                       "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
                   "index 3");
    for (std::size_t kept = 0; kept < vertices.size() + 13; ++kept)
        refusal(write("cut.ply", (start + "element vertex 3\n" + xyz + "element face 1\n" + face + vertices + "\x03" +
                                  raw<std::int32_t>({0, 1, 2}))
                                     .substr(0, 150 + kept)));
}

TEST_F(Import, instance_bombs_and_cycles_are_refused_before_they_expand) {
    std::string nodes = "[";
    for (int i = 1; i <= 40; ++i) nodes += fmt::format(R"({{"children":[{0},{0}]}},)", i);
    expect_refusal("bomb.gltf", gltf(nodes + R"({"mesh":0}])", "[0]"), "two parents");
    expect_refusal("cycle.gltf", gltf(R"([{"children":[1]},{"children":[0],"mesh":0}])", "[0]"), "");
    expect_refusal("child.gltf", gltf(R"([{"children":[7],"mesh":0}])", "[0]"), "does not exist");
    std::string chain = "[";
    for (int i = 1; i <= 100000; ++i) chain += fmt::format(R"({{"children":[{}]}},)", i);
    expect_refusal("deep.gltf", gltf(chain + R"({"mesh":0}])", "[0]"), "flatter");
}

TEST_F(Import, sizes_larger_than_a_gltf_file_are_refused) {
    std::string json = gltf(R"([{"mesh":0}])", "[0]");
    json.append(3 - (json.size() + 3) % 4, ' ');  // chunks are whole words
    const auto size = static_cast<std::uint32_t>(json.size());
    const auto glb = [&](std::uint32_t json_length, std::uint32_t data_length = 72) {
        return std::string("glTF") + raw<std::uint32_t>({2, 28 + size + 72, json_length}) + "JSON" + json +
               raw<std::uint32_t>({data_length}) + std::string("BIN\0", 4) + raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
               std::string(36, '\0');
    };
    EXPECT_EQ(triangle_count(import_scene(write("fine.glb", glb(size)))), 1u);
    for (const std::uint32_t length : {size + 81, 0x40000000u, 0xfffffff0u})
        expect_refusal("chunk.glb", glb(length), "a chunk of");
    expect_refusal("data.glb", glb(size, 0xfffffff0u), "a chunk of");
    std::string zeros = json;
    const std::string view = R"("bufferView":0,"componentType":5126,"count":3)";
    zeros.replace(zeros.find(view), view.size(), R"("componentType":5126,"count":1000000000)");
    expect_refusal("zeros.gltf", zeros, "without data");
}

TEST_F(Import, a_giant_polygon_is_refused) {
    std::string obj;
    std::string face = "f";
    for (int i = 1; i <= 5000; ++i) {
        obj += fmt::format("v {} {} 0\n", std::cos(i * 6.283185 / 5000), std::sin(i * 6.283185 / 5000));
        face += fmt::format(" {}", i);
    }
    expect_refusal("giant.obj", obj + face + "\n", "5000 corners");
}

TEST_F(Import, textures_that_are_missing_or_outside_the_folder_are_named_in_a_note) {
    std::ofstream(folder_ / "secret.png") << "not for you";
    const std::string obj =
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";
    for (const std::string name : {"gone.png", "../secret.png", "/etc/passwd"}) {
        write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd " + name + "\n");
        const Scene scene = import_scene(write("t.obj", obj));
        EXPECT_FALSE(scene.meshes[0].material.base_color_texture);
        ASSERT_EQ(scene.notes.size(), 1u);
        EXPECT_NE(scene.notes[0].find("texture '" + name + "' is not found"), std::string::npos) << scene.notes[0];
    }
    fs::create_symlink(folder_ / "secret.png", folder_ / "meshes" / "link.png");
    write("m.mtl", "newmtl a\nmap_Kd link.png\n");
    const Scene linked = import_scene(write("t.obj", obj));
    EXPECT_FALSE(linked.meshes[0].material.base_color_texture);
    EXPECT_EQ(linked.notes.size(), 1u);
    // A glowing surface whose map is missing does not glow all over.
    write("m.mtl", "newmtl a\nKd 1 1 1\nKe 1 1 1\nmap_Ke gone.png\n");
    EXPECT_EQ(import_scene(write("t.obj", obj)).meshes[0].material.emission, (Rgb{0, 0, 0}));
}

// Paths of the machine on which the file was made.
TEST_F(Import, a_texture_beside_the_mesh_is_found_by_the_last_part_of_its_name) {
    write("near.ppm", "P6 1 1 255\n" + std::string("\xff\x00\x00", 3));
    const std::string obj =
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";
    for (const std::string path : {"C:\\Users\\me\\near.ppm", "/home/me/near.ppm", "../textures/near.ppm"}) {
        write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd " + path + "\n");
        const Scene scene = import_scene(write("t.obj", obj));
        EXPECT_TRUE(scene.meshes[0].material.base_color_texture) << path;
        EXPECT_TRUE(scene.notes.empty()) << path;
    }
}

TEST_F(Import, files_that_are_black_all_over_are_shown_in_grey) {
    const std::string obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 2 3\n";
    write("m.mtl", "newmtl a\nKd 0 0 0\nnewmtl b\nKd 1 0 0\n");
    const Scene black = import_scene(write("t.obj", obj));
    EXPECT_EQ(black.meshes[0].material.base_color, Material{}.base_color);
    EXPECT_EQ(black.notes.size(), 1u);
    const Scene tyres = import_scene(write("t.obj", obj + "usemtl b\nf 1 3 4\n"));
    EXPECT_EQ(tyres.meshes.at(0).material.base_color, (Rgb{0, 0, 0}));
    EXPECT_TRUE(tyres.notes.empty());
}

TEST_F(Import, a_mesh_far_from_the_origin_is_named) {
    const auto notes_at = [&](double x) {
        return import_scene(
                   write("t.stl", fmt::format("solid t\nfacet normal 0 0 1\nouter loop\nvertex {:.3f} 0 0\n"
                                              "vertex {:.3f} 0 0\nvertex {:.3f} 1 0\nendloop\nendfacet\nendsolid t\n",
                                              x, x + 1, x)))
            .notes;
    };
    EXPECT_TRUE(notes_at(100).empty());
    ASSERT_EQ(notes_at(400000).size(), 1u);
    EXPECT_NE(notes_at(400000)[0].find("from the origin"), std::string::npos);
}

TEST_F(Import, buffers_outside_the_folder_are_not_opened) {
    std::ofstream(folder_ / "outside.bin", std::ios::binary)
        << raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) << std::string(36, '\0');
    std::string text = gltf(R"([{"mesh":0}])", "[0]");
    const std::size_t at = text.find("data:application");
    text.replace(at, text.find('"', at) - at, "../outside.bin");
    refusal(write("traversal.gltf", text));
    fs::copy(folder_ / "outside.bin", folder_ / "meshes" / "inside.bin");
    text.replace(text.find("../outside.bin"), 14, "inside.bin");
    EXPECT_EQ(triangle_count(import_scene(write("inside.gltf", text))), 1u);
}

}  // namespace
}  // namespace hogel::scene::mesh_files
