// SPDX-License-Identifier: Apache-2.0
// Mesh files as programs of others write them: not as the formats' papers say, and yet plain.
#include <cmath>

#include "hogel/scene/mesh_files/import_fixture.h"
#include "hogel/scene/mesh_files/orient.h"

namespace hogel::scene::mesh_files {
namespace {

class Strangers : public Import {
  protected:
    Scene import(const std::string& name, const std::string& bytes) { return import_scene(write(name, bytes)); }
    void write_picture(const std::string& name) {
        fs::create_directories((folder_ / "meshes" / name).parent_path());
        write(name, "P6 1 1 255\n\xff\x80\x40");
    }
};

/// A square of four vertices; `further` are lines of the vertices' properties, `values` are appended to each vertex.
std::string square(const std::string& further, const std::string& values, const std::string& rest) {
    std::string text = ply_vertices(4, further) + rest;
    const std::size_t end = text.find("end_header\n") + 11;
    return text.insert(end, fmt::format("0 0 0{0}\n1 0 0{0}\n1 1 0{0}\n0 1 0{0}\n", values));
}
const std::string face_list = "property list uchar int vertex_indices\n";

bool is_bright(Rgb color) { return color.r > 0.9f && color.g < 0.1f && color.b < 0.1f; }

TEST_F(Strangers, ply_elements_come_in_any_order) {
    const std::string color_first =
        "ply\nformat ascii 1.0\nelement color 1\nproperty int channel\nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\nproperty double phase\n";
    const Scene points = import("points.ply", color_first + "end_header\n3\n0 0 0 1\n1 0 0 1\n0 1 0 1\n");
    EXPECT_EQ(points.meshes.at(0).name, "points");
    EXPECT_EQ(points.notes, std::vector<std::string>{"phases of points are left out"});
    const Scene face_first =
        import("faces.ply", "ply\nformat ascii 1.0\nelement face 1\n" + face_list +
                                "element vertex 3\nproperty float z\nproperty float y\nproperty float x\n"
                                "end_header\n3 0 1 2\n0 0 0\n0 0 1\n0 1 0\n");
    EXPECT_EQ(triangle_count(face_first), 1u);
    EXPECT_EQ(bounds(face_first).high, (Vec3{1, 1, 0}));
}

TEST_F(Strangers, ply_strips_begin_anew_at_minus_one) {
    const Scene scene =
        import("strips.ply", ply_vertices(6) +
                                 "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                                 "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n8 0 1 2 3 -1 2 3 4\n");
    EXPECT_EQ(triangle_count(scene), 3u);
    EXPECT_TRUE(scene.notes.empty());
    for (const Vec3 normal : scene.meshes[0].normals) EXPECT_NEAR(normal.z, 1, 1e-12);
}

TEST_F(Strangers, ply_colours_have_the_names_of_several_programs) {
    for (const char* prefix : {"", "diffuse_"}) {
        const std::string colors =
            fmt::format("property uchar {0}red\nproperty uchar {0}green\nproperty uchar {0}blue\n", prefix);
        const Scene scene =
            import("c.ply", square(colors, " 255 0 0", "element face 1\n" + face_list + "end_header\n4 0 1 2 3\n"));
        ASSERT_EQ(scene.meshes[0].colors.size(), 4u) << prefix;
        EXPECT_TRUE(is_bright(scene.meshes[0].colors[0])) << prefix;
    }
}

TEST_F(Strangers, ply_faces_have_colours) {
    const Scene scene = import("f.ply", square("", "",
                                               "element face 2\n" + face_list + ply_colors +
                                                   "end_header\n"
                                                   "3 0 1 2 255 0 0\n3 0 2 3 0 255 0\n"));
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
    for (const std::uint32_t corner : mesh.triangles.at(0)) EXPECT_TRUE(is_bright(mesh.colors[corner]));
    for (const std::uint32_t corner : mesh.triangles.at(1)) EXPECT_GT(mesh.colors[corner].g, 0.9f);
    EXPECT_TRUE(scene.notes.empty());
}

TEST_F(Strangers, ply_corners_have_texture_coordinates_and_faces_pictures) {
    write_picture("a.ppm");
    write_picture("b.ppm");
    std::string text = square("", "",
                              "element face 2\n" + face_list +
                                  "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
                                  "3 0 1 2 6 0 0 1 0 1 1 0\n3 0 2 3 6 0.5 0 1 0.5 0 1 1\n");
    text.insert(text.find("element"), "comment TextureFile a.ppm\ncomment TextureFile b.ppm\n");
    const Scene scene = import("w.ply", text);
    ASSERT_EQ(scene.meshes.size(), 2u);
    for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(mesh.material.base_color_texture);
    const Mesh& second = scene.meshes[1];
    EXPECT_EQ(second.texture_coordinates.at(second.triangles.at(0)[0]).u, 0.5f);
    // One picture: the seam between the two faces stays one.
    text.erase(text.find("comment TextureFile b.ppm\n"), 26);
    for (std::size_t at; (at = text.find(" 1\n3 0 2 3")) != text.npos;) text.erase(at, 2);
    const std::string one = square("", "",
                                   "element face 2\n" + face_list +
                                       "property list uchar float texcoord\nend_header\n"
                                       "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0.5 0 1 0.5 0 1\n");
    const Mesh mesh = import("seam.ply", one).meshes.at(0);
    EXPECT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.texture_coordinates.at(mesh.triangles[0][2]).v, 1);
    EXPECT_EQ(mesh.texture_coordinates.at(mesh.triangles[1][1]).v, 0.5f);
    expect_refusal("few.ply", one.substr(0, one.rfind("6 0.5")) + "4 0.5 0 1 0.5\n",
                   "3 corners and 4 texture coordinates");
}

TEST_F(Strangers, vertices_that_nothing_uses_need_no_place) {
    const Scene ply = import("n.ply", ply_vertices(4) + "element face 1\n" + face_list +
                                          "end_header\n0 0 0\n1 0 0\n0 1 0\nnan nan nan\n3 0 1 2\n");
    const Scene off = import("n.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\nnan nan nan\n3 0 1 2\n");
    for (const Scene& scene : {ply, off}) EXPECT_EQ(bounds(scene).high, (Vec3{1, 1, 0}));
}

TEST_F(Strangers, off_faces_have_colours) {
    const std::string start = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    for (const char* colors : {"255 0 0", "1.0 0 0", "255 0 0 255"}) {
        const Scene scene = import("f.off", start + "3 0 1 2 " + colors + "\n3 0 2 3\n");
        const Mesh& mesh = scene.meshes[0];
        ASSERT_EQ(mesh.colors.size(), mesh.positions.size()) << colors;
        EXPECT_TRUE(is_bright(mesh.colors[mesh.triangles[0][0]])) << colors;
        EXPECT_NEAR(mesh.colors[mesh.triangles[1][2]].g, 0.6, 1e-6) << colors;
    }
    EXPECT_NE(import("t.off", start + "3 0 1 2 17\n3 0 2 3\n").notes.at(0).find("of 1 faces"), std::string::npos);
}

TEST_F(Strangers, texts_begin_with_a_byte_order_mark) {
    const std::string mark = "\xEF\xBB\xBF", triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    write("m.mtl", mark + "newmtl red\nKd 1 0 0\n");
    const Scene obj = import("m.obj", mark + "mtllib m.mtl\n" + triangle + "usemtl red\nf 1 2 3\n");
    EXPECT_TRUE(is_bright(obj.meshes[0].material.base_color));
    const std::string ply =
        ply_vertices(3) + "element face 1\n" + face_list + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(triangle_count(import("m.ply", mark + ply)), 1u);
    EXPECT_EQ(triangle_count(import("m.off", mark + "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")), 1u);
    EXPECT_EQ(
        triangle_count(import("m.stl", mark + "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                              "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n")),
        1u);
}

TEST_F(Strangers, pictures_are_named_in_every_way) {
    write_picture("maps/Wood.ppm");
    write_picture("maps/my wood.ppm");
    const auto has_picture = [&](const std::string& library, const std::string& name) {
        fs::create_directories(folder_ / "meshes" / "maps");
        write(library, "newmtl wood\nKd 1 1 1\nmap_Kd " + name + "\n");
        const Scene scene = import("p.obj", "mtllib " + library +
                                                "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                                "usemtl wood\nf 1/1 2/2 3/3\n");
        return scene.meshes[0].material.base_color_texture != nullptr && scene.notes.empty();
    };
    EXPECT_TRUE(has_picture("p.mtl", "maps/Wood.ppm"));
    EXPECT_TRUE(has_picture("maps/p.mtl", "Wood.ppm"));  // relative to the library
    EXPECT_TRUE(has_picture("p.mtl", "Maps/wood.PPM"));
    EXPECT_TRUE(has_picture("p.mtl", "\"maps/my wood.ppm\""));
    EXPECT_TRUE(has_picture("p.mtl", "C:\\models\\maps\\Wood.ppm"));
    EXPECT_TRUE(has_picture("p.mtl", "..\\models\\maps\\wood.ppm"));
    EXPECT_FALSE(has_picture("p.mtl", "steel.ppm"));
    write("../secret.ppm", "P6 1 1 255\n\xff\x80\x40");
    EXPECT_FALSE(has_picture("p.mtl", "../secret.ppm"));
}

/// A binary STL file of triangles side by side.
std::string stl(std::uint32_t announced, int held) {
    std::string bytes = std::string(80, ' ') + raw<std::uint32_t>({announced});
    for (int i = 0; i < held; ++i) {
        const auto x = static_cast<float>(i);
        bytes += raw<float>({0, 0, 1, x, 0, 0, x + 1, 0, 0, x, 1, 0}) + std::string(2, '\0');
    }
    return bytes;
}

TEST_F(Strangers, stl_counts_are_counted) {
    EXPECT_TRUE(import("right.stl", stl(3, 3)).notes.empty());
    for (const std::uint32_t announced : {0u, 2u, 0xFFFFFFFFu}) {
        const Scene scene = import("wrong.stl", stl(announced, 3));
        EXPECT_EQ(triangle_count(scene), 3u);
        EXPECT_EQ(scene.notes.at(0),
                  fmt::format("it announces {} triangles: all 3 that it holds are shown", announced));
    }
    const Scene longer = import("longer.stl", stl(3, 3) + "written by a program");
    EXPECT_EQ(triangle_count(longer), 3u);
    EXPECT_EQ(longer.notes.at(0), "20 bytes behind its last triangle are left out");
    expect_refusal("cut.stl", stl(5, 3), "announces 5 triangles and holds 3");
}

TEST_F(Strangers, messages_of_the_importer_name_no_folder) {
    const fs::path path = write("words.dae", "these are only words\n");
    const std::string message = refusal(path);
    EXPECT_EQ(message.find(folder_.string(), path.string().size()), std::string::npos) << message;
}

// A place in UTM coordinates: single floats have steps of half a metre there.
TEST_F(Strangers, obj_far_from_the_origin_keeps_its_shape) {
    const Scene scene = import("far.obj",
                               "v 500000.125 5400000.25 10 1 0 0\nv 500000.375 5400000.25 10 1 0 0\n"
                               "v 500000.125 5400000.75 10.5 1 0 0\nf 1 2 3\n");
    const auto [low, high] = bounds(scene);
    EXPECT_NEAR(high.x - low.x, 0.25, 1e-6);
    EXPECT_NEAR(high.y - low.y, 0.5, 1e-6);
    EXPECT_NEAR(low.y, 5400000.25, 1e-6);
    EXPECT_TRUE(is_bright(scene.meshes[0].colors.at(0)));
    EXPECT_EQ(bounds(import("near.obj", "v 1 2 3\nv 2 2 3\nv 1 4 3\nf 1 2 3\n")).high, (Vec3{2, 4, 3}));
}

TEST_F(Strangers, ply_says_how_exact_its_coordinates_are) {
    for (const bool exact : {false, true}) {
        const Scene scene =
            import("far.ply", fmt::format("ply\nformat ascii 1.0\nelement vertex 3\nproperty {0} x\nproperty {0} y\n"
                                          "property {0} z\nelement face 1\n{1}end_header\n500000.125 0 0\n"
                                          "500000.375 0 0\n500000.125 0.5 0\n3 0 1 2\n",
                                          exact ? "double" : "float", face_list));
        EXPECT_EQ(scene.notes.size(), exact ? 0u : 1u);
    }
}

std::string cube_of(double x, double size, bool inwards, int first) {
    std::string text;
    for (int i = 0; i < 8; ++i)
        text += fmt::format("v {} {} {}\n", x + size * (i & 1), size * (i >> 1 & 1), size * (i >> 2));
    const int faces[6][4]{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces)
        text += fmt::format("f {} {} {} {}\n", first + f[0], first + f[inwards ? 3 : 1], first + f[2],
                            first + f[inwards ? 1 : 3]);
    return text;
}

TEST_F(Strangers, each_shell_faces_outwards) {
    for (const bool small_inwards : {false, true})
        for (const bool large_inwards : {false, true}) {
            const Scene scene = import("two.obj", cube_of(0, 1, small_inwards, 1) + cube_of(5, 3, large_inwards, 9));
            const Mesh& mesh = scene.meshes[0];
            for (const auto& [a, b, c] : mesh.triangles) {
                const auto& p = mesh.positions;
                const Vec3 center = p[a].x < 3 ? Vec3{0.5, 0.5, 0.5} : Vec3{6.5, 1.5, 1.5};
                EXPECT_GT(dot(cross(p[b] - p[a], p[c] - p[a]), p[a] - center), 0);
                EXPECT_GT(dot(mesh.normals[a], p[a] - center), 0);
            }
            EXPECT_FALSE(mesh.material.double_sided);
            EXPECT_EQ(scene.notes.size(), small_inwards || large_inwards ? 1u : 0u);
            if (small_inwards != large_inwards) {
                EXPECT_EQ(scene.notes.at(0), "1 of its 2 closed surfaces face inwards: they are turned inside out");
            }
        }
}

TEST_F(Strangers, dat_clouds_have_amplitudes) {
    const Scene scene = import("p.dat", "3\n0 0 0 0 0.5 1\n1 1 0 0 0.5 2\n2 0 1 0 0.5 1\n");
    EXPECT_EQ(scene.meshes.at(0).name, "points");
    EXPECT_NEAR(scene.meshes[0].colors.at(0).r, 0.25, 1e-6);
    expect_refusal("few.dat", "3\n0 0 0 0 0.5 1\n", "announces 3 points and has 1");
    expect_refusal("other.dat", "3 4 5\n", "line 1 has 3 numbers; expected one");
}

}  // namespace
}  // namespace hogel::scene::mesh_files
