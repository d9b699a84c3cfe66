// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/provenance.h"

namespace hogel {
namespace {

using Json = nlohmann::ordered_json;

constexpr int floats = 5126, unsigned_ints = 5125, vertex_data = 34962, index_data = 34963;
constexpr std::uint32_t magic = 0x46546C67, version = 2, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

/// Builder of a glTF file: JSON and binary data.
class Gltf {
  public:
    Gltf() {
        json["asset"] = {{"version", "2.0"}, {"generator", "hogel"}};
        json["extensionsUsed"] = {"KHR_materials_unlit"};
        json["scene"] = 0;
    }

    /// Adds an array of elements of `components` numbers each, and returns the index of its accessor.
    template <class T>
    std::size_t accessor(const std::vector<T>& numbers, std::size_t components, int target) {
        const std::size_t view = buffer_view(numbers.data(), numbers.size() * sizeof(T), target);
        static constexpr const char* types[] = {"", "SCALAR", "VEC2", "VEC3"};
        json["accessors"].push_back({{"bufferView", view},
                                     {"componentType", std::is_same_v<T, float> ? floats : unsigned_ints},
                                     {"count", numbers.size() / components},
                                     {"type", types[components]}});
        return json["accessors"].size() - 1;
    }

    std::size_t texture(const Image& image) {
        const std::vector<unsigned char> png = encode_png(image);
        json["images"].push_back({{"bufferView", buffer_view(png.data(), png.size(), 0)}, {"mimeType", "image/png"}});
        json["textures"].push_back({{"source", json["images"].size() - 1}});
        return json["textures"].size() - 1;
    }

    /// Returns the complete file.
    std::vector<unsigned char> bytes() {
        json["buffers"] = {{{"byteLength", data_.size()}}};
        std::string text = json.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::size_t total = 12 + 8 + text.size() + 8 + data_.size();
        if (total > std::numeric_limits<std::uint32_t>::max())
            throw Error(ErrorCode::cannot_write,
                        fmt::format("a .glb file of {:.3g} GB; expected at most 4.29 GB, the limit of the format",
                                    static_cast<double>(total) / 1e9));
        std::vector<unsigned char> file;
        file.reserve(total);
        const auto append = [&file](const void* from, std::size_t size) {
            const auto* first = static_cast<const unsigned char*>(from);
            file.insert(file.end(), first, first + size);
        };
        const auto number = [&](std::size_t value) {
            const auto word = static_cast<std::uint32_t>(value);  // little-endian, like this machine
            append(&word, sizeof word);
        };
        number(magic), number(version), number(total);
        number(text.size()), number(json_chunk), append(text.data(), text.size());
        number(data_.size()), number(binary_chunk), append(data_.data(), data_.size());
        return file;
    }

    Json json;

  private:
    std::size_t buffer_view(const void* from, std::size_t size, int target) {
        Json view{{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", size}};
        if (target != 0) view["target"] = target;
        json["bufferViews"].push_back(std::move(view));
        const auto* first = static_cast<const unsigned char*>(from);
        data_.insert(data_.end(), first, first + size);
        data_.resize((data_.size() + 3) / 4 * 4);
        return json["bufferViews"].size() - 1;
    }

    std::vector<unsigned char> data_;
};

std::vector<float> packed(const std::vector<Vec3>& values) {
    std::vector<float> list;
    for (const Vec3& v : values)
        for (const double x : {v.x, v.y, v.z}) list.push_back(static_cast<float>(x));
    return list;
}

/// Adds positions with the bounds that glTF requires, and returns their accessor.
std::size_t add_positions(Gltf& gltf, const std::vector<float>& positions) {
    const std::size_t accessor = gltf.accessor(positions, 3, vertex_data);
    Json& box = gltf.json["accessors"].back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float low = std::numeric_limits<float>::infinity(), high = -low;
        for (std::size_t i = axis; i < positions.size(); i += 3)
            low = std::min(low, positions[i]), high = std::max(high, positions[i]);
        box["min"].push_back(low), box["max"].push_back(high);
    }
    return accessor;
}

void add_mesh(Gltf& gltf, const Mesh& mesh, std::map<const Image*, std::size_t>& textures) {
    if (mesh.radiance.size() != mesh.positions.size())
        throw Error(ErrorCode::bad_input,
                    fmt::format("mesh '{}': brings no radiance; expected one a vertex", mesh.name));
    std::vector<float> colors, coordinates;
    for (const Rgb& c : mesh.radiance) colors.insert(colors.end(), {c.r, c.g, c.b});
    std::vector<std::uint32_t> indices;
    for (const auto& [a, b, c] : mesh.triangles) indices.insert(indices.end(), {a, b, c});

    Json attributes{{"POSITION", add_positions(gltf, packed(mesh.positions))}};
    if (!mesh.normals.empty()) attributes["NORMAL"] = gltf.accessor(packed(mesh.normals), 3, vertex_data);
    attributes["COLOR_0"] = gltf.accessor(colors, 3, vertex_data);

    Json material{
        {"name", mesh.name}, {"doubleSided", true}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
    material["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
    if (const auto& image = mesh.material.base_color_texture; image && !mesh.texture_coordinates.empty()) {
        for (const TextureCoordinate& t : mesh.texture_coordinates)
            coordinates.insert(coordinates.end(), {t.u, 1 - t.v});  // glTF's v points downwards
        attributes["TEXCOORD_0"] = gltf.accessor(coordinates, 2, vertex_data);
        const auto [known, is_new] = textures.try_emplace(image.get(), 0);
        if (is_new) known->second = gltf.texture(*image);
        material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", known->second}};
    }
    gltf.json["materials"].push_back(std::move(material));
    const Json primitive{{"attributes", std::move(attributes)},
                         {"indices", gltf.accessor(indices, 1, index_data)},
                         {"material", gltf.json["materials"].size() - 1}};
    gltf.json["meshes"].push_back({{"name", mesh.name}, {"primitives", {primitive}}});
    const std::size_t number = gltf.json["meshes"].size() - 1;
    gltf.json["nodes"].push_back({{"mesh", number}, {"name", mesh.name}});
    gltf.json["scenes"][0]["nodes"].push_back(gltf.json["nodes"].size() - 1);
}

}  // namespace

void require_baked_scene_name(const std::filesystem::path& path) {
    if (path.extension() != ".glb")
        throw Error(ErrorCode::usage, fmt::format("{}: expected a name that ends in .glb", path.string()));
}

void write_baked_scene(const std::filesystem::path& path, const Scene& scene, const Metadata& metadata) {
    require_baked_scene_name(path);
    validate(scene);
    Gltf gltf;
    Metadata history{{"scene", scene.name}};
    for (const auto& [key, text] : with_history(metadata, with_history(std::move(history), scene.provenance)))
        gltf.json["asset"]["extras"]["hogel"][key] = text;
    std::map<const Image*, std::size_t> textures;
    for (const Mesh& mesh : scene.meshes)
        if (!mesh.triangles.empty()) add_mesh(gltf, mesh, textures);
    core::write_file(path, gltf.bytes());
}

}  // namespace hogel
