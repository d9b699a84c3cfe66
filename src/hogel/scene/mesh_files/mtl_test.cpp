// SPDX-License-Identifier: Apache-2.0
// OBJ files with their material libraries, and notes of what other formats say: each statement is read, or a note names
// it.
#include "hogel/scene/mesh_files/mtl.h"

#include <algorithm>
#include <array>
#include <vector>

#include "hogel/scene/mesh_files/import_fixture.h"

namespace hogel::scene::mesh_files {
namespace {

// A TGA file of 24 bits with rows of these grey texels, the top one first.
std::string grey(const std::vector<std::vector<int>>& rows) {
    std::string bytes(18, '\0');
    bytes[2] = 2, bytes[12] = static_cast<char>(rows[0].size()), bytes[14] = static_cast<char>(rows.size());
    bytes[16] = 24, bytes[17] = 0x20;
    for (const auto& row : rows)
        for (const int value : row) bytes.append(3, static_cast<char>(value));
    return bytes;
}

class Libraries : public Import {
  protected:
    Scene read(const std::string& statements, const std::string& further = {}) {
        write("a.mtl", "newmtl old oak\n" + statements);
        return import_scene(write("a.obj",
                                  "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl old oak\n"
                                  "f 1/1 2/2 3/3\n" +
                                      further));
    }
    Mesh mesh(const std::string& statements) { return read(statements).meshes.at(0); }
    static void expect_note(const Scene& scene, const std::string& words) {
        EXPECT_TRUE(
            std::ranges::any_of(scene.notes, [&](const std::string& note) { return note.find(words) != note.npos; }))
            << words << " is not in " << scene.notes.size() << " notes"
            << (scene.notes.empty() ? "" : ": " + scene.notes[0]);
    }
};

TEST_F(Libraries, have_opacity) {
    EXPECT_EQ(mesh("Kd 1 0 0\n").material.alpha_mode, AlphaMode::opaque);
    const Material glass = mesh("Kd 1 0 0\nd 0.25\n").material;
    EXPECT_EQ(glass.alpha_mode, AlphaMode::blend);
    EXPECT_EQ(glass.alpha, 0.25f);
    EXPECT_EQ(glass.base_color.r, 1);
    EXPECT_EQ(mesh("Tr 0.25\n").material.alpha, 0.75f);
    // Programs that write 1 for opaque as Tr write d too.
    EXPECT_EQ(mesh("d 1\nTr 1\n").material.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(mesh("Tr 1\r\nd 1.0\r\n").material.alpha_mode, AlphaMode::opaque);
    expect_note(read("d 0\n"), "material 'old oak' is invisible");
    EXPECT_TRUE(read("Kd 1 0 0\nKa 1 1 1\nd 0.5\n").notes.empty());
}

TEST_F(Libraries, have_pictures_of_opacity) {
    write("holes.tga", grey({{0, 255, 255}, {255, 255, 0}}));
    write("smoke.tga", grey({{128, 64}}));
    write("wood.tga", grey({{255, 0}, {0, 255}}));
    const Material leaf = mesh("map_d holes.tga\n").material;
    EXPECT_EQ(leaf.alpha_mode, AlphaMode::mask);
    ASSERT_TRUE(leaf.base_color_texture);
    ASSERT_EQ(leaf.base_color_texture->channels(), 4u);
    EXPECT_EQ(leaf.base_color_texture->pixels(0, 0, 3), 0);
    EXPECT_EQ(leaf.base_color_texture->pixels(0, 1, 3), 1);
    EXPECT_EQ(leaf.base_color_texture->pixels(0, 0, 0), 1);  // white: the base colour stays
    const Material smoke = mesh("map_Kd wood.tga\nmap_d -imfchan l smoke.tga\n").material;
    EXPECT_EQ(smoke.alpha_mode, AlphaMode::blend);
    ASSERT_EQ(smoke.base_color_texture->height(), 2u);
    EXPECT_NEAR(smoke.base_color_texture->pixels(1, 0, 3), 128 / 255.0, 1e-6);
    EXPECT_NEAR(smoke.base_color_texture->pixels(1, 1, 3), 64 / 255.0, 1e-6);
    EXPECT_EQ(smoke.base_color_texture->pixels(1, 1, 1), 1);
}

TEST_F(Libraries, have_emission) {
    write("wood.tga", grey({{255, 0}, {0, 255}}));
    const Material plain = mesh("map_Kd wood.tga\nKe 2 1 0.5\n").material;
    EXPECT_EQ(plain.emission, (Rgb{2, 1, 0.5f}));
    ASSERT_TRUE(plain.emission_texture);  // of one white texel, so that the wood does not multiply it
    EXPECT_EQ(plain.emission_texture->width(), 1u);
    const Material mapped = mesh("map_Ke wood.tga\n").material;
    EXPECT_EQ(mapped.emission, (Rgb{1, 1, 1}));
    ASSERT_TRUE(mapped.emission_texture);
    EXPECT_EQ(mapped.emission_texture->width(), 2u);
    EXPECT_FALSE(mapped.base_color_texture);
}

TEST_F(Libraries, have_options_of_pictures) {
    write("my wood.tga", grey({{255, 0}, {0, 255}}));
    const Mesh moved = mesh("map_Kd -clamp on -s 2 3 1 -o 0.5 0.25 my wood.tga\n");
    ASSERT_TRUE(moved.material.base_color_texture);
    EXPECT_EQ(moved.material.base_color_sampling.wrap_u, TextureSampling::Wrap::clamp);
    EXPECT_EQ(moved.texture_coordinates.at(1).u, 2.5f);
    EXPECT_EQ(moved.texture_coordinates.at(1).v, 0.25f);
    EXPECT_EQ(moved.texture_coordinates.at(2).v, 3.25f);
    const auto parsed = parse_mtl("newmtl a\nmap_Kd -mm 0.5 2 -t 1 1 1 -type sphere x.png\n");
    ASSERT_EQ(parsed.size(), 1u);
    EXPECT_EQ(parsed[0].color.name, "x.png");
    EXPECT_EQ(parsed[0].left_out.size(), 2u);
    EXPECT_FALSE(parsed[0].color.is_moved());
}

TEST_F(Libraries, say_what_is_left_out) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"Ks 1 1 1\nNs 10\n", "highlights (Ks, Ns) of 1 material"},
        {"map_Bump x.png\n", "bump maps"},
        {"norm x.png\n", "normal maps"},
        {"disp x.png\n", "displacement maps"},
        {"refl -type sphere x.png\n", "reflection maps"},
        {"map_Ks x.png\n", "maps of highlights"},
        {"illum 7\n", "mirrors and glass"},
        {"Pm 1\n", "roughness and metal"},
        {"Tf 1 0.5 0\n", "colours of light that passes (Tf)"}};
    for (const auto& [statement, words] : cases) expect_note(read(statement), words);
    EXPECT_TRUE(read("Ks 1 1 1\nillum 1\n").notes.empty());
    EXPECT_TRUE(read("Ks 0 0 0\nPs 0\nTf 1 1 1\nNi 1.45\n").notes.empty());
    expect_note(read("", "l 1 2\n"), "1 points or lines are left out");
    expect_note(read("", "curv 0 1 1 2\nend\n"), "free-form curves");
    write("a.mtl", "newmtl a\nd -halo 0.5\n");
    expect_refusal("c.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n", "halo");
    expect_note(import_scene(write("b.obj", "mtllib grün.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
                "its material library 'grün.mtl' is not found");
}

TEST_F(Libraries, of_other_formats_are_noted_too) {
    const std::string end = "end_header\n0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2 255 0 0\n";
    expect_note(
        import_scene(write("f.ply", ply_vertices(3, ply_colors) +
                                        "element face 1\nproperty list uchar int vertex_indices\n" + ply_colors + end)),
        "colours of faces are left out");
    const Scene part = import_scene(write("p.stl",
                                          "solid p\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                          "vertex 0 1 0\nendloop\nendfacet\nendsolid p\n"));
    EXPECT_EQ(part.up, (Vec3{0, 0, 1}));
    EXPECT_EQ(read("").up, (Vec3{0, 1, 0}));
    expect_note(
        import_scene(
            write("c.dae",
                  R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset>
<library_lights><light id="l"><technique_common><point><color>1 1 1</color></point></technique_common></light></library_lights>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
<node id="m" name="m"><instance_light url="#l"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)")),
        "1 light is left out");
}

}  // namespace
}  // namespace hogel::scene::mesh_files
