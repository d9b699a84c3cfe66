// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "hogel/scene/mesh_files/checks.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::size_t max_depth = 1000;

/// The JSON part of a .gltf or .glb file. Throws unless the chunks of a .glb file are inside it, because assimp
/// allocates the sizes that they state.
std::string_view json_part(const std::string& file, std::string_view bytes) {
    if (!bytes.starts_with("glTF")) return bytes;
    std::string_view json;
    for (std::size_t at = 12; at < bytes.size();) {
        std::uint32_t length = 0;  // little-endian, like this machine
        if (bytes.size() - at >= 8) std::memcpy(&length, bytes.data() + at, sizeof length);
        if (bytes.size() - at < 8 || length > bytes.size() - at - 8)
            reject_file(file, fmt::format("a chunk of {} bytes at byte {}", length, at), "one that ends in the file");
        if (json.empty()) json = bytes.substr(at + 8, length);
        at += 8 + std::size_t{length};
    }
    return json;
}

// Refuses accessors without data, which represent zeros, so that a few bytes could request any number of elements.
void check_accessors(const std::string& file, const nlohmann::json& document, std::size_t file_size) {
    const auto accessors = document.find("accessors");
    if (accessors == document.end() || !accessors->is_array()) return;
    for (const auto& accessor : *accessors) {
        if (!accessor.is_object() || accessor.contains("bufferView")) continue;
        const auto count = accessor.find("count");
        if (count != accessor.end() && count->is_number() && count->get<double>() > static_cast<double>(file_size))
            reject_file(file, fmt::format("an accessor of {} elements without data", count->get<double>()),
                        "no more than the file has bytes");
    }
}

}  // namespace

// glTF: "the node hierarchy MUST be a set of disjoint strict trees". assimp copies a node once for every parent, and
// walks the trees recursively.
void check_gltf(const std::string& file, std::string_view bytes) {
    const auto document = nlohmann::json::parse(json_part(file, bytes), nullptr, false);
    if (!document.is_object()) return;  // assimp reports what is wrong
    check_accessors(file, document, bytes.size());
    const auto nodes = document.find("nodes");
    if (nodes == document.end() || !nodes->is_array()) return;
    constexpr std::size_t none = ~std::size_t{0};
    std::vector<std::size_t> parent(nodes->size(), none);
    for (std::size_t i = 0; i < nodes->size(); ++i) {
        const auto& node = (*nodes)[i];
        if (!node.is_object()) continue;
        const auto children = node.find("children");
        if (children == node.end() || !children->is_array()) continue;
        for (const auto& child : *children) {
            if (!child.is_number_unsigned() || child.get<std::size_t>() >= parent.size())
                reject_file(file, fmt::format("node {} has a child that does not exist", i), "the index of a node");
            std::size_t& known = parent[child.get<std::size_t>()];
            if (known != none)
                reject_file(file, fmt::format("node {} has two parents", child.get<std::size_t>()), "a strict tree");
            known = i;
        }
    }
    // Each node has at most one parent, so a node is too deep or on a cycle exactly if the path upwards does not end
    // within the limit.
    for (std::size_t i = 0; i < parent.size(); ++i) {
        std::size_t depth = 0;
        for (std::size_t at = i; at != none; at = parent[at])
            if (++depth > max_depth)
                reject_file(file, fmt::format("node {} lies below more than {} others", i, max_depth),
                            "a flatter tree");
    }
}

}  // namespace hogel::scene::mesh_files
