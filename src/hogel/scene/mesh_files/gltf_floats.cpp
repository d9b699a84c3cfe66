// SPDX-License-Identifier: Apache-2.0
// Conversion of integer attributes: texture coordinates, and with KHR_mesh_quantization positions and normals.
#include <fmt/format.h>

#include <cstring>
#include <map>

#include "hogel/scene/mesh_files/gltf.h"

namespace hogel::scene::mesh_files {
namespace {

std::string encode_base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

/// Adds an accessor with the values of another one converted to floats. Returns its index.
std::size_t add_floats(Gltf& gltf, const GltfAccessor& accessor, std::size_t number) {
    Json& json = gltf.json;
    const Json& old = json["accessors"][number];
    const auto flag = old.find("normalized");
    const std::vector<float> values = accessor.floats(flag != old.end() && *flag == true);
    const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    Json added{{"componentType", GltfAccessor::f32},
               {"count", accessor.count},
               {"type", accessor.type},
               {"bufferView", json["bufferViews"].size()}};
    json["bufferViews"].push_back({{"buffer", json["buffers"].size()}, {"byteLength", bytes.size()}});
    json["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}});
    if (accessor.type == "VEC3") {  // positions require bounds, but no reader uses them
        added["min"] = {0, 0, 0};
        added["max"] = {0, 0, 0};
    }
    json["accessors"].push_back(std::move(added));
    return json["accessors"].size() - 1;
}

}  // namespace

std::string data_uri(std::string_view bytes) { return "data:application/octet-stream;base64," + encode_base64(bytes); }

void make_floats(Gltf& gltf, const std::vector<GltfAccessor>& accessors) {
    std::map<std::size_t, std::size_t> made;
    for (std::size_t m = 0; m < gltf.list("meshes").size(); ++m) {
        Json& primitives = gltf.json["meshes"][m]["primitives"];
        for (Json& primitive : primitives)
            for (auto& [name, value] : primitive["attributes"].items()) {
                if (name != "POSITION" && name != "NORMAL" && !name.starts_with("TEXCOORD_")) continue;
                const std::size_t number = value;
                if (accessors[number].component_type == GltfAccessor::f32) continue;
                const auto [known, is_new] = made.emplace(number, 0);
                if (is_new) known->second = add_floats(gltf, accessors[number], number);
                value = known->second;
            }
    }
}

}  // namespace hogel::scene::mesh_files
