// SPDX-License-Identifier: Apache-2.0
// glTF materials: small generated files; each feature is read, noted or rejected.
#include <algorithm>
#include <numbers>
#include <vector>

#include "hogel/image.h"
#include "hogel/scene/mesh_files/import_fixture.h"

namespace hogel::scene::mesh_files {
namespace {

// A square of 2 × 2 texels, R, G, B, A from 0 to 255, as a PNG file is too long to write by hand: a TGA file of 32
// bits, whose first row is the top one.
std::string picture(const std::vector<std::array<int, 4>>& texels) {
    std::string bytes(18, '\0');
    bytes[2] = 2, bytes[12] = 2, bytes[14] = 2, bytes[16] = 32, bytes[17] = 0x28;
    for (const auto& [r, g, b, a] : texels)
        for (const int value : {b, g, r, a}) bytes += static_cast<char>(value);
    return bytes;
}
const std::vector<std::array<int, 4>> four{{255, 0, 0, 255}, {0, 255, 0, 0}, {0, 0, 255, 128}, {255, 255, 255, 51}};

/// The parts of a document in which tests differ; JSON.
struct Parts {
    std::string material = "{}", node = R"("mesh":0)", document = {}, texture = R"("source":0)", samplers = {},
                attributes = {};
};

/// Two triangles with positions, TEXCOORD_0 (the unit square), TEXCOORD_1 (a half of it), and colours with alpha.
std::string file(const Parts& parts) {
    const std::string pixels = picture(four);
    const std::string bytes = raw<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) + raw<float>({0, 1, 1, 1, 1, 0, 0, 0}) +
                              raw<float>({0, 0.5f, 0.5f, 0.5f, 0.5f, 0, 0, 0}) +
                              raw<float>({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0.5f, 1, 1, 1, 0.25f}) +
                              raw<std::uint16_t>({0, 1, 2, 0, 2, 3}) + raw<float>({0, 0, 0, 5, 0, 0, 0, 7, 0}) +
                              raw<float>({1, 1, 1, 2, 2, 2, 3, 3, 3});
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},{}"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{{}}}],"materials":[{}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2{}}},"indices":4,"material":0}}]}}],
"textures":[{{{}}}],"samplers":[{{{}}}],"images":[{{"uri":"data:image/x-tga;base64,{}"}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}},{{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"}},
{{"bufferView":3,"componentType":5126,"count":4,"type":"VEC4"}},{{"bufferView":4,"componentType":5123,"count":6,"type":"SCALAR"}},
{{"bufferView":5,"componentType":5126,"count":3,"type":"VEC3"}},{{"bufferView":6,"componentType":5126,"count":3,"type":"VEC3"}}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},
{{"buffer":0,"byteOffset":80,"byteLength":32}},{{"buffer":0,"byteOffset":112,"byteLength":64}},
{{"buffer":0,"byteOffset":176,"byteLength":12}},{{"buffer":0,"byteOffset":188,"byteLength":36}},
{{"buffer":0,"byteOffset":224,"byteLength":36}}],
"buffers":[{{"byteLength":260,"uri":"data:application/octet-stream;base64,{}"}}]}})",
        parts.document, parts.node, parts.material, parts.attributes, parts.texture, parts.samplers, base64(pixels),
        base64(bytes));
}

class Looks : public Import {
  protected:
    Scene read(const Parts& parts) { return import_scene(write("x.gltf", file(parts))); }
    Mesh mesh(const Parts& parts) { return read(parts).meshes.at(0); }
    void expect_note(const Parts& parts, const std::string& words) {
        const std::vector<std::string> notes = read(parts).notes;
        EXPECT_TRUE(std::ranges::any_of(notes, [&](const std::string& note) { return note.find(words) != note.npos; }))
            << words << " is not in " << notes.size() << " notes" << (notes.empty() ? "" : ": " + notes[0]);
    }
};

TEST_F(Looks, of_a_plain_material_there_is_nothing_to_note) {
    const Scene scene = read({});
    EXPECT_TRUE(scene.notes.empty());
    EXPECT_TRUE(scene.lights.empty());
    const Material& material = scene.meshes[0].material;
    EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(material.metallic, 1);  // glTF's default
    EXPECT_EQ(material.base_color, (Rgb{1, 1, 1}));
}

TEST_F(Looks, masks_and_blending_have_the_alpha_of_factor_vertices_and_texture) {
    const Mesh mask = mesh({.material = R"({"alphaMode":"MASK","alphaCutoff":0.3,"pbrMetallicRoughness":
        {"baseColorFactor":[0.5,0.25,1,0.75],"baseColorTexture":{"index":0}}})",
                            .attributes = R"(,"COLOR_0":3)"});
    EXPECT_EQ(mask.material.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(mask.material.alpha_cutoff, 0.3f);
    EXPECT_EQ(mask.material.alpha, 0.75f);
    EXPECT_EQ(mask.alphas, (std::vector<float>{1, 1, 0.5f, 0.25f}));
    const Image& texture = *mask.material.base_color_texture;
    ASSERT_EQ(texture.channels(), 4u);
    EXPECT_EQ(texture.pixels(0, 1, 3), 0);
    EXPECT_NEAR(texture.pixels(1, 0, 3), 128 / 255.0, 1e-6);  // without a transfer curve
    EXPECT_EQ(mesh({.material = R"({"alphaMode":"BLEND"})"}).material.alpha_mode, AlphaMode::blend);
    EXPECT_EQ(mesh({.material = R"({"alphaMode":"MASK"})"}).material.alpha_cutoff, 0.5f);
    // Alpha means nothing on an opaque surface.
    const Mesh opaque = mesh(
        {.material = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})", .attributes = R"(,"COLOR_0":3)"});
    EXPECT_TRUE(opaque.alphas.empty());
    EXPECT_EQ(opaque.material.base_color_texture->channels(), 3u);
    EXPECT_EQ(opaque.colors.size(), 4u);
}

TEST_F(Looks, emission_has_a_texture_and_a_strength) {
    const Mesh glowing = mesh({.material = R"({"emissiveFactor":[1,0.5,0],"emissiveTexture":{"index":0},
        "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}}})"});
    EXPECT_EQ(glowing.material.emission, (Rgb{4, 2, 0}));
    ASSERT_TRUE(glowing.material.emission_texture);
    EXPECT_EQ(glowing.emission_coordinates.size(), 4u);
    // A base-colour texture does not multiply emission that has no texture.
    const Mesh plain = mesh({.material = R"({"emissiveFactor":[1,1,1],"pbrMetallicRoughness":
        {"baseColorTexture":{"index":0}}})"});
    ASSERT_TRUE(plain.material.emission_texture);
    EXPECT_EQ(plain.material.emission_texture->pixels(0, 0, 0), 1);
}

TEST_F(Looks, metal_and_roughness_are_numbers_of_a_texture) {
    const Mesh metal = mesh({.material = R"({"pbrMetallicRoughness":{"metallicFactor":0.5,"roughnessFactor":0.75,
        "metallicRoughnessTexture":{"index":0}}})"});
    EXPECT_EQ(metal.material.metallic, 0.5f);
    EXPECT_EQ(metal.material.roughness, 0.75f);
    ASSERT_TRUE(metal.material.metallic_roughness_texture);
    EXPECT_EQ(metal.material.metallic_roughness_texture->pixels(1, 1, 1), 1);
    EXPECT_EQ(metal.metallic_roughness_coordinates.size(), 4u);
}

TEST_F(Looks, textures_have_a_set_of_coordinates_a_transform_and_a_sampler) {
    const Mesh second = mesh({.material = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})"});
    ASSERT_EQ(second.texture_coordinates.size(), 4u);
    EXPECT_EQ(second.texture_coordinates[1].u, 0.5f);
    EXPECT_EQ(second.texture_coordinates[1].v, 0.5f);  // glTF's v points down
    // A quarter turn, scaled and moved: u' = 0.5 + 3 v, v' = 0.25 − 2 u, in glTF's coordinates.
    const Mesh turned = mesh({.material = fmt::format(
                                  R"({{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0,"extensions":
        {{"KHR_texture_transform":{{"offset":[0.5,0.25],"scale":[2,3],"rotation":{}}}}}}}}}}})",
                                  std::numbers::pi / 2),
                              .document = R"("extensionsUsed":["KHR_texture_transform"],)"});
    const std::array<std::array<float, 2>, 4> corners{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};  // of TEXCOORD_0
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(turned.texture_coordinates[i].u, 0.5 + 3 * corners[i][1], 1e-6);
        EXPECT_NEAR(turned.texture_coordinates[i].v, 1 - (0.25 - 2 * corners[i][0]), 1e-6);
    }
    const Mesh sampled = mesh({.material = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})",
                               .texture = R"("source":0,"sampler":0)",
                               .samplers = R"("wrapS":33071,"wrapT":33648,"magFilter":9728)"});
    const TextureSampling expected{TextureSampling::Wrap::clamp, TextureSampling::Wrap::mirror, true};
    EXPECT_EQ(sampled.material.base_color_sampling, expected);
}

TEST_F(Looks, materials_have_one_side_or_two) {
    EXPECT_FALSE(mesh({}).material.double_sided);
    EXPECT_FALSE(mesh({.material = R"({"doubleSided":false})"}).material.double_sided);
    EXPECT_TRUE(mesh({.material = R"({"doubleSided":true})"}).material.double_sided);
    Scene scene = read({});
    const std::uint32_t single = checksum(scene);
    scene.meshes[0].material.double_sided = true;
    EXPECT_NE(checksum(scene), single);
}

TEST_F(Looks, other_descriptions_of_a_material_become_this_one) {
    const Mesh glass = mesh({.material = R"({"extensions":{"KHR_materials_ior":{"ior":2},
        "KHR_materials_specular":{"specularFactor":0.5}}})"});
    EXPECT_NEAR(glass.material.reflectance, 0.5 / 9, 1e-6);
    const Mesh old = mesh({.material = R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":
        {"diffuseFactor":[0.5,0.25,0.125,1],"specularFactor":[0.1,0.1,0.1],"glossinessFactor":0.75,
        "diffuseTexture":{"index":0}}}})"});
    EXPECT_EQ(old.material.base_color, (Rgb{0.5f, 0.25f, 0.125f}));
    EXPECT_EQ(old.material.metallic, 0);
    EXPECT_EQ(old.material.roughness, 0.25f);
    EXPECT_NEAR(old.material.reflectance, 0.1, 1e-6);
    EXPECT_TRUE(old.material.base_color_texture);
}

TEST_F(Looks, instances_stand_where_their_node_and_their_attributes_say) {
    const std::string extension = R"("extensions":{"EXT_mesh_gpu_instancing":{"attributes":)";
    const Scene scene =
        read({.node = R"("mesh":0,"translation":[100,0,0],)" + extension + R"({"TRANSLATION":5,"SCALE":6}}})",
              .document = R"("extensionsRequired":["EXT_mesh_gpu_instancing"],)"});
    ASSERT_EQ(scene.meshes.size(), 3u);
    std::vector<Vec3> corners;
    for (const Mesh& copy : scene.meshes) corners.push_back(copy.positions[2]);
    std::ranges::sort(corners, {}, &Vec3::x);
    EXPECT_EQ(corners[0], (Vec3{101, 1, 0}));
    EXPECT_EQ(corners[1], (Vec3{103, 10, 0}));
    EXPECT_EQ(corners[2], (Vec3{107, 2, 0}));
    expect_refusal("a.gltf", file({.node = R"("mesh":0,)" + extension + R"({"ROTATION":5}}})"}), "ROTATION is VEC3");
    expect_refusal("b.gltf", file({.node = R"("mesh":0,)" + extension + R"({}}})"}), "has no place");
}

TEST_F(Looks, whole_numbers_are_positions_and_texture_coordinates) {
    const std::string bytes = raw<std::int16_t>({0, 0, 0, 0, 30, 0, 0, 0, 0, -20, 4, 0}) +
                              raw<std::uint8_t>({0, 255, 0, 0, 255, 51, 0, 0, 0, 0, 0, 0});
    const Scene scene = import_scene(
        write("q.gltf", fmt::format(R"({{"asset":{{"version":"2.0"}},"extensionsRequired":["KHR_mesh_quantization"],
"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"scale":[0.1,0.1,0.1]}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":0}}]}}],
"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"textures":[{{"source":0}}],
"images":[{{"uri":"data:image/x-tga;base64,{}"}}],
"accessors":[{{"bufferView":0,"componentType":5122,"count":3,"type":"VEC3","min":[0,-20,0],"max":[30,0,4]}},
{{"bufferView":1,"componentType":5121,"normalized":true,"count":3,"type":"VEC2"}}],
"bufferViews":[{{"buffer":0,"byteLength":24,"byteStride":8}},{{"buffer":0,"byteOffset":24,"byteLength":12,"byteStride":4}}],
"buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,{}"}}]}})",
                                    base64(picture(four)), base64(bytes))));
    const Bounds box = bounds(scene);
    EXPECT_NEAR(box.high.x, 3, 1e-6);
    EXPECT_NEAR(box.low.y, -2, 1e-6);
    EXPECT_NEAR(box.high.z, 0.4, 1e-6);
    const auto& coordinates = scene.meshes[0].texture_coordinates;
    ASSERT_EQ(coordinates.size(), 3u);
    EXPECT_EQ(coordinates[1].u, 1);
    EXPECT_NEAR(coordinates[1].v, 1 - 0.2, 1e-6);
    EXPECT_EQ(coordinates[0].v, 0);
    expect_refusal("r.gltf", file({.attributes = R"(,"NORMAL":4)"}), "NORMAL is not three floats");
}

TEST_F(Looks, lights_shine_from_where_their_nodes_are) {
    const Parts parts{
        .node = R"("mesh":0,"children":[1,2]},{"translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},
{"rotation":[0.70710678,0,0,0.70710678],"extensions":{"KHR_lights_punctual":{"light":1}})",
        .document = R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":8,"color":[1,0.5,0]},
{"type":"directional"}]}},)"};
    const Scene scene = read(parts);
    ASSERT_EQ(scene.lights.size(), 2u);
    const auto point = std::ranges::find(scene.lights, Light::Kind::point, &Light::kind);
    ASSERT_NE(point, scene.lights.end());
    EXPECT_EQ(point->position, (Vec3{1, 2, 3}));
    EXPECT_EQ(point->intensity, (Rgb{8, 4, 0}));
    const auto sun = std::ranges::find(scene.lights, Light::Kind::directional, &Light::kind);
    ASSERT_NE(sun, scene.lights.end());
    EXPECT_NEAR(sun->direction.y, 1, 1e-6);  // −z, turned by a quarter about x
    EXPECT_EQ(sun->intensity, (Rgb{1, 1, 1}));
    Parts spot = parts;
    spot.document.replace(spot.document.find("\"point\""), 7, "\"spot\"");
    const Scene spotted = read(spot);
    const auto cone = std::ranges::find(spotted.lights, Light::Kind::point, &Light::kind);
    ASSERT_NE(cone, spotted.lights.end());
    EXPECT_EQ(cone->direction, (Vec3{0, 0, -1}));
    EXPECT_NEAR(cone->outer_cone, std::numbers::pi / 4, 1e-12);  // glTF's defaults
    EXPECT_EQ(cone->inner_cone, 0);
    EXPECT_TRUE(spotted.notes.empty());
    spot.document.replace(spot.document.find("\"intensity\""), 0,
                          R"("range":9,"spot":{"innerConeAngle":0.25,"outerConeAngle":0.5},)");
    const Scene narrow = read(spot);
    EXPECT_EQ(std::ranges::find(narrow.lights, Light::Kind::point, &Light::kind)->inner_cone, 0.25);
    EXPECT_EQ(std::ranges::find(narrow.lights, Light::Kind::point, &Light::kind)->outer_cone, 0.5);
    expect_note(spot, "lights[0] has a range");
    Parts unknown = parts;
    unknown.document.replace(unknown.document.find("\"point\""), 7, "\"glow\"");
    expect_refusal("x.gltf", file(unknown), "lights[0].type is unknown");
}

TEST_F(Looks, maps_of_normals_and_of_occlusion_have_their_factors) {
    const Mesh relief = mesh({.material = R"({"normalTexture":{"index":0,"scale":0.5,"texCoord":1},
        "occlusionTexture":{"index":0,"strength":0.25}})"});
    ASSERT_TRUE(relief.material.normal_texture);
    EXPECT_EQ(relief.material.normal_texture->pixels(1, 1, 2), 1);
    EXPECT_NEAR(relief.material.normal_texture->pixels(0, 1, 1), 1, 1e-6);  // numbers without a transfer curve
    EXPECT_EQ(relief.material.normal_scale, 0.5f);
    EXPECT_EQ(relief.normal_coordinates.at(1).u, 0.5f);
    ASSERT_TRUE(relief.material.occlusion_texture);
    EXPECT_EQ(relief.material.occlusion_strength, 0.25f);
    EXPECT_EQ(relief.occlusion_coordinates.at(1).u, 1);
    EXPECT_TRUE(read({.material = R"({"normalTexture":{"index":0},"occlusionTexture":{"index":0}})"}).notes.empty());
}

TEST_F(Looks, cameras_stand_where_their_nodes_are) {
    const std::string node = R"("mesh":0,"children":[1]},{"name":"left","translation":[1,2,3],"camera":0,
"rotation":[0,0.70710678,0,0.70710678],"scale":[2,2,2])";
    const std::string lens = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.25}}],)";
    const Scene scene = read({.node = node, .document = lens});
    ASSERT_EQ(scene.cameras.size(), 1u);
    const SceneCamera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "left");
    EXPECT_EQ(camera.position, (Vec3{1, 2, 3}));
    EXPECT_EQ(camera.angle, 0.5);
    EXPECT_NEAR(camera.nearest, 0.5, 1e-6);
    EXPECT_NEAR(length(camera.right - Vec3{0, 0, -1}), 0, 1e-6);  // −z, turned by a quarter about y, is −x
    EXPECT_NEAR(length(camera.up - Vec3{0, 1, 0}), 0, 1e-6);
    const Scene both = read(
        {.node = R"("mesh":0,"children":[1,2]},{"name":"a","camera":0},{"name":"b","camera":0)", .document = lens});
    ASSERT_EQ(both.cameras.size(), 2u);
    EXPECT_EQ(both.cameras[0].name, "a");  // in the order of the nodes
    const Scene parallel =
        read({.node = node, .document = R"("cameras":[{"type":"orthographic","orthographic":{"ymag":3,"znear":0}}],)"});
    EXPECT_EQ(parallel.cameras.at(0).angle, 0);
    EXPECT_NEAR(parallel.cameras.at(0).height, 12, 1e-6);
    EXPECT_TRUE(scene.notes.empty());
    expect_refusal("a.gltf", file({.node = node, .document = R"("cameras":[{"type":"perspective"}],)"}),
                   "cameras[0].perspective missing");
    expect_refusal("b.gltf", file({.node = node, .document = R"("cameras":[{"type":"fisheye"}],)"}),
                   "cameras[0].type is unknown");
}

TEST_F(Looks, vertices_that_are_split_for_normals_keep_all_that_they_have) {
    // Two triangles at a right angle share an edge, and no normals are given.
    const std::string bytes = raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + raw<float>({0, 0, 1, 0, 0, 1, 1, 1}) +
                              raw<std::uint16_t>({0, 1, 2, 0, 2, 3});
    const Scene scene = import_scene(
        write("s.gltf",
              fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2,"material":0}}]}}],
"materials":[{{"emissiveFactor":[1,1,1],"emissiveTexture":{{"index":0}},"normalTexture":{{"index":0}},
"occlusionTexture":{{"index":0}},"pbrMetallicRoughness":{{"metallicRoughnessTexture":{{"index":0}}}}}}],
"textures":[{{"source":0}}],"images":[{{"uri":"data:image/x-tga;base64,{}"}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
{{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}},{{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},{{"buffer":0,"byteOffset":80,"byteLength":12}}],
"buffers":[{{"byteLength":92,"uri":"data:application/octet-stream;base64,{}"}}]}})",
                          base64(picture(four)), base64(bytes))));
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.emission_coordinates.size(), 6u);
    EXPECT_EQ(mesh.metallic_roughness_coordinates.size(), 6u);
    EXPECT_EQ(mesh.normal_coordinates.size(), 6u);
    EXPECT_EQ(mesh.occlusion_coordinates.size(), 6u);
    validate(scene);
}

TEST_F(Looks, what_is_left_out_is_noted_by_name) {
    for (const std::string name :
         {"anisotropy", "clearcoat", "dispersion", "iridescence", "sheen", "transmission", "volume"})
        expect_note({.material = R"({"extensions":{"KHR_materials_)" + name + R"(":{}}})"}, "KHR_materials_" + name);
    expect_note({.document = R"("animations":[{"channels":[],"samplers":[]}],)"}, "animations are left out");
    expect_note({.document = R"("skins":[{"joints":[0]}],)"}, "skins are left out");
    expect_note({.document = R"("extensionsUsed":["ACME_glow","KHR_materials_ior"],)"}, "left out: ACME_glow");
    const std::string textured = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
    expect_note({.material = textured, .texture = R"("extensions":{"KHR_texture_basisu":{"source":0}})"}, "KTX2");
    expect_note({.material = textured, .texture = R"("extensions":{"MSFT_texture_dds":{"source":0}})"}, "no picture");
    expect_note({.material = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":2}}})"},
                "TEXCOORD_2");
}

TEST_F(Looks, what_packs_a_file_is_refused_by_name_where_it_is_required) {
    const std::string name = "KHR_texture_basisu";
    expect_refusal("x.gltf", file({.document = R"("extensionsRequired":[")" + name + R"("],)"}), name);
}

TEST_F(Looks, wrong_values_are_refused_with_their_place) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"({"alphaMode":"GLASS"})", "materials[0].alphaMode is unknown"},
        {R"({"alphaCutoff":"high"})", "materials[0].alphaCutoff is not a number"},
        {R"({"doubleSided":1})", "materials[0].doubleSided is neither true nor false"},
        {R"({"emissiveFactor":[1,1]})", "materials[0].emissiveFactor is no such list; expected 3"},
        {R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}})", "baseColorTexture.index is 1"},
        {R"({"pbrMetallicRoughness":{"baseColorTexture":{}}})", "baseColorTexture.index missing"},
        {R"({"pbrMetallicRoughness":3})", "materials[0].pbrMetallicRoughness is not an object"},
        {R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"scale":[1]}}}}})",
         "KHR_texture_transform.scale is no such list; expected 2"}};
    for (const auto& [material, words] : cases) expect_refusal("x.gltf", file({.material = material}), words);
    const std::string textured = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
    expect_refusal("x.gltf",
                   file({.material = textured, .texture = R"("source":0,"sampler":0)", .samplers = R"("wrapS":7)"}),
                   "samplers[0].wrapS is 7");
}

TEST_F(Looks, numbers_of_obj_files_may_begin_with_their_point) {
    const Scene scene = import_scene(write(
        "x.obj", "# -.5 stays\nv -.5 -.25 .125\nv  +.5 0 0\nv 0 .75 1e-3\nvt .5 .5\nvn 0 0 1\nf 1//1 2//1 3//1\n"));
    const Bounds box = bounds(scene);
    EXPECT_EQ(box.low, (Vec3{-0.5, -0.25, 0}));
    EXPECT_EQ(box.high.x, 0.5);
    EXPECT_EQ(box.high.y, 0.75);
    EXPECT_EQ(box.high.z, 0.125);
}

}  // namespace
}  // namespace hogel::scene::mesh_files
