// SPDX-License-Identifier: Apache-2.0
// One .glb file with many features of glTF, each on a tile of its own, rendered by several renderers: what is seen is
// what the specification says, by numbers that can be found without a program.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "hogel/pipeline.h"

namespace hogel {
namespace {

using Json = nlohmann::json;

constexpr double spacing = 4e-3, half = 1.5e-3, row = 3e-3;  // of tiles, metres

/// A .glb file that grows.
class Glb {
  public:
    Json json{{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", Json::array()}}}}};

    template <class T>
    std::size_t add_accessor(const std::vector<T>& values, const std::string& type, std::size_t components) {
        const std::size_t bytes = values.size() * sizeof(T), before = binary_.size();
        binary_.append(reinterpret_cast<const char*>(values.data()), bytes);
        Json accessor{{"bufferView", add_view(before, bytes)},
                      {"componentType", std::is_same_v<T, float> ? 5126 : 5123},
                      {"count", values.size() / components},
                      {"type", type}};
        if (type == "VEC3") accessor.update({{"min", {-1, -1, -1}}, {"max", {1, 1, 1}}});
        return add("accessors", accessor);
    }
    std::size_t add_view(std::size_t before, std::size_t bytes) {
        while (binary_.size() % 4 != 0) binary_ += '\0';
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", before}, {"byteLength", bytes}});
    }
    std::size_t add_bytes(const std::string& bytes) {
        const std::size_t before = binary_.size();
        binary_ += bytes;
        return add_view(before, bytes.size());
    }
    std::size_t add(const char* list, const Json& object) {
        json[list].push_back(object);
        return json[list].size() - 1;
    }
    void add_root(const Json& node) { json["scenes"][0]["nodes"].push_back(add("nodes", node)); }

    void write(const std::filesystem::path& path) {
        json["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        std::string text = json.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const auto word = [](std::size_t value) {
            const auto number = static_cast<std::uint32_t>(value);
            return std::string(reinterpret_cast<const char*>(&number), 4);
        };
        std::ofstream(path, std::ios::binary)
            << "glTF" << word(2) << word(28 + text.size() + binary_.size()) << word(text.size()) << "JSON" << text
            << word(binary_.size()) << std::string("BIN\0", 4) << binary_;
    }

  private:
    std::string binary_;
};

/// A tile of which tests change parts.
struct Tile {
    Json material;
    double u_and_v = 1;              ///< to which TEXCOORD_0 runs
    std::vector<float> second = {};  ///< TEXCOORD_1 at all corners
    std::vector<float> color = {};   ///< of all vertices
    bool from_behind = false;
};

std::size_t add_mesh(Glb& file, const Tile& tile) {
    const float h = static_cast<float>(half), z = tile.from_behind ? -1.0f : 1.0f, w = static_cast<float>(tile.u_and_v);
    Json attributes{{"POSITION", file.add_accessor<float>({-h, -h, 0, h, -h, 0, h, h, 0, -h, h, 0}, "VEC3", 3)},
                    {"NORMAL", file.add_accessor<float>({0, 0, z, 0, 0, z, 0, 0, z, 0, 0, z}, "VEC3", 3)},
                    {"TEXCOORD_0", file.add_accessor<float>({0, w, w, w, w, 0, 0, 0}, "VEC2", 2)}};
    const auto four_times = [](const std::vector<float>& value) {
        std::vector<float> values;
        for (int i = 0; i < 4; ++i) values.insert(values.end(), value.begin(), value.end());
        return values;
    };
    if (!tile.second.empty()) attributes["TEXCOORD_1"] = file.add_accessor(four_times(tile.second), "VEC2", 2);
    if (!tile.color.empty()) attributes["COLOR_0"] = file.add_accessor(four_times(tile.color), "VEC3", 3);
    const std::vector<std::uint16_t> front{0, 1, 2, 0, 2, 3}, back{0, 2, 1, 0, 3, 2};
    return file.add("meshes", {{"primitives",
                                {{{"attributes", attributes},
                                  {"indices", file.add_accessor(tile.from_behind ? back : front, "SCALAR", 1)},
                                  {"material", file.add("materials", tile.material)}}}}});
}

Json at(double column, double line, double z = 0) { return {(column - 2) * spacing, (1 - 2 * line) * row, z}; }

Json matt(std::vector<double> color) { return {{"metallicFactor", 0}, {"baseColorFactor", std::move(color)}}; }
Json textured(std::size_t texture, const Json& more = Json::object()) {
    Json use{{"index", texture}};
    use.update(more);
    return {{"metallicFactor", 0}, {"baseColorTexture", use}};
}

/// Red, and green that is not there; below them blue and white. A TGA file.
std::string picture() {
    std::string bytes(18, '\0');
    bytes[2] = 2, bytes[12] = 2, bytes[14] = 2, bytes[16] = 32, bytes[17] = 0x28;
    return bytes + std::string("\0\0\xff\xff\0\xff\0\0\xff\0\0\xff\xff\xff\xff\xff", 16);
}

void add_tiles(Glb& file) {
    file.json["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_emissive_strength", "KHR_lights_punctual",
                                   "EXT_mesh_gpu_instancing"};
    file.add("images", {{"bufferView", file.add_bytes(picture())}, {"mimeType", "image/x-tga"}});
    file.add("samplers", {{"magFilter", 9728}});
    file.add("samplers", {{"magFilter", 9728}, {"wrapS", 33648}, {"wrapT", 33071}});
    const std::size_t repeated = file.add("textures", {{"source", 0}, {"sampler", 0}}),
                      mirrored = file.add("textures", {{"source", 0}, {"sampler", 1}});
    const auto place = [&](double column, double line, const Tile& tile, double z = 0) {
        file.add_root({{"mesh", add_mesh(file, tile)}, {"translation", at(column, line, z)}});
    };
    place(0, 0, {.material = {{"pbrMetallicRoughness", matt({0.5, 1, 1, 1})}}, .color = {0.25f, 0.5f, 0.75f}});
    place(1, 0, {.material = {{"pbrMetallicRoughness", textured(repeated)}, {"alphaMode", "MASK"}}});
    place(2, 0,
          {.material = {{"pbrMetallicRoughness", textured(repeated, {{"texCoord", 1}})}}, .second = {0.75f, 0.25f}});
    const Json shifted{{"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.5}}}}}}};
    place(3, 0, {.material = {{"pbrMetallicRoughness", textured(repeated, shifted)}}});
    place(4, 0, {.material = {{"pbrMetallicRoughness", textured(mirrored)}}, .u_and_v = 2});
    place(0, 1,
          {.material = {{"pbrMetallicRoughness", matt({0, 0, 0, 1})},
                        {"emissiveFactor", {0.5, 0.25, 1}},
                        {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}}});
    place(1, 1, {.material = {{"pbrMetallicRoughness", matt({1, 0, 0, 1})}}}, -1e-3);
    place(1, 1, {.material = {{"pbrMetallicRoughness", matt({1, 1, 1, 0.25})}, {"alphaMode", "BLEND"}}}, 1e-3);
    const std::size_t copied = add_mesh(file, {.material = {{"pbrMetallicRoughness", matt({0, 0, 1, 1})}}});
    const auto shift = static_cast<float>(spacing);
    const Json copies{{"TRANSLATION", file.add_accessor<float>({0, 0, 0, shift, 0, 0}, "VEC3", 3)},
                      {"SCALE", file.add_accessor<float>({1, 1, 1, 0.5f, 0.5f, 0.5f}, "VEC3", 3)}};
    file.add_root({{"mesh", copied},
                   {"translation", at(2, 1)},
                   {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", copies}}}}}});
    place(4, 1,
          {.material = {{"pbrMetallicRoughness", matt({1, 1, 0, 1})}, {"doubleSided", true}}, .from_behind = true});
    // Its radiance on a white surface that faces it is 1.
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", std::numbers::pi}}};
    file.add_root({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.add("cameras", {{"type", "orthographic"},
                         {"orthographic", {{"xmag", 2.5e-3}, {"ymag", 2.5e-3}, {"znear", 0}, {"zfar", 1}}}});
    file.add_root({{"name", "fourth"}, {"camera", 0}, {"translation", at(3, 0, 0.1)}});
}

class GltfFeatures : public ::testing::Test {
  protected:
    GltfFeatures() {
        std::string name = std::filesystem::temp_directory_path() / "hogel_gltf_XXXXXX";
        folder_ = mkdtemp(name.data());
        request_.grid = {40, 40, 0.5e-3, 1, 1, field_of_view(0.01)};
        request_.fit = false;
        Glb file;
        add_tiles(file);
        file.write(folder_ / "tiles.glb");
    }
    ~GltfFeatures() override { std::filesystem::remove_all(folder_); }

    void render() {
        const Scene scene = load_scene(folder_ / "tiles.glb", request_);
        notes_ = scene.notes;
        seen_ = std::make_unique<LightFieldBuffer>(request_.grid);
        copy(render_light_field(scene, request_).front(), *seen_);
    }
    /// The radiance of the hogel at a place.
    Rgb radiance(double x, double y) const {
        const auto s = static_cast<std::size_t>(20 + x / 0.5e-3), t = static_cast<std::size_t>(20 - y / 0.5e-3);
        const auto& values = seen_->radiance;
        return {values(0, t, s, 0, 0), values(1, t, s, 0, 0), values(2, t, s, 0, 0)};
    }
    /// Expects a radiance on a tile, at shares of its half side from its middle.
    void expect(int column, int line, double right, double up, Rgb expected) const {
        const Rgb found =
            radiance((column - 2) * spacing + right * half + 1e-9, (1 - 2 * line) * row + up * half - 1e-9);
        for (const auto& [is, should] : {std::pair{found.r, expected.r}, {found.g, expected.g}, {found.b, expected.b}})
            EXPECT_NEAR(is, should, 1e-4) << "tile " << column << " " << line << ", " << right << " " << up << ", "
                                          << request_.renderer << " " << request_.shading.model;
    }

    std::filesystem::path folder_;
    LightFieldRequest request_;
    std::vector<std::string> notes_;
    std::unique_ptr<LightFieldBuffer> seen_;
};

constexpr Rgb none{0, 0, 0}, red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1}, white{1, 1, 1};

TEST_F(GltfFeatures, are_seen_as_the_specification_says) {
    for (const char* renderer : {"epi", "raytrace", "zbuffer"})
        for (const char* model : {"vertex", "shadowed"}) {
            request_.renderer = renderer;
            request_.shading.model = model;
            render();
            expect(0, 0, 0, 0, {0.125f, 0.5f, 0.75f});  // colours of vertices, times the factor
            expect(1, 0, -0.5, 0.5, red);               // a mask
            expect(1, 0, 0.5, 0.5, none);
            expect(1, 0, -0.5, -0.5, blue);
            expect(1, 0, 0.5, -0.5, white);
            expect(2, 0, -0.5, -0.5, green);  // TEXCOORD_1; alpha means nothing on an opaque surface
            expect(2, 0, 0.5, 0.5, green);
            expect(3, 0, -0.5, 0.5, white);  // a transform, past the edge of a picture that is repeated
            expect(3, 0, 0.5, 0.5, blue);
            expect(3, 0, -0.5, -0.5, green);
            expect(3, 0, 0.5, -0.5, red);
            expect(4, 0, 0.2, 0.8, green);  // mirrored across, continued downwards
            expect(4, 0, 0.8, 0.8, red);
            expect(4, 0, -0.8, -0.2, blue);
            expect(4, 0, 0.8, -0.2, blue);
            expect(0, 1, 0, 0, {2, 1, 4});          // emission and its strength
            expect(1, 1, 0, 0, {1, 0.25f, 0.25f});  // a quarter of white over red
            expect(2, 1, 0.8, 0.8, blue);           // an instance, and one of half the size
            expect(3, 1, 0.2, 0.2, blue);
            expect(3, 1, 0.8, 0.8, none);
            expect(4, 1, 0, 0, {1, 1, 0});  // the back of a double-sided tile
        }
    ASSERT_EQ(notes_.size(), 1u);  // the camera's
    EXPECT_NE(notes_[0].find("'fourth'"), std::string::npos);
}

// The picture of the camera is a quarter of the hologram's height: the fourth tile is six millimetres from the middle.
TEST_F(GltfFeatures, are_seen_from_a_camera_of_the_file) {
    request_.pose.camera = "fourth";
    request_.shading.model = "vertex";
    render();
    const auto expect_at = [&](double x, double y, Rgb expected) {
        const Rgb found = radiance(x, y);
        EXPECT_NEAR(found.r, expected.r, 1e-4) << x << " " << y;
        EXPECT_NEAR(found.g, expected.g, 1e-4) << x << " " << y;
        EXPECT_NEAR(found.b, expected.b, 1e-4) << x << " " << y;
    };
    expect_at(-5.6e-3, 5.6e-3, white);
    expect_at(5.6e-3, 5.6e-3, blue);
    expect_at(-5.6e-3, -5.6e-3, green);
    expect_at(5.6e-3, -5.6e-3, red);
    expect_at(6.6e-3, 0, none);
    expect_at(0, -6.6e-3, none);
}

}  // namespace
}  // namespace hogel
