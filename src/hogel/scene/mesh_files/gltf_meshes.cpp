// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/gltf.h"

namespace hogel::scene::mesh_files {
namespace {

/// Returns 12 for "TEXCOORD_12", 0 for names without number; nothing if invalid. assimp allocates all lower numbers.
std::optional<std::size_t> set_number(std::string_view attribute) {
    const std::size_t underscore = attribute.find('_');
    if (underscore == attribute.npos || underscore == 0) return 0;  // not numbered, or application-specific
    const std::string_view digits = attribute.substr(underscore + 1);
    std::size_t number = 0;
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (status != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
    return number;
}

class Primitives {
  public:
    Primitives(const Gltf& gltf, const std::vector<GltfAccessor>& accessors) : gltf_(gltf), accessors_(accessors) {
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            is_quantized_ = is_quantized_ || std::ranges::count(gltf.list(list), "KHR_mesh_quantization") > 0;
    }

    void check(const Json& primitive, const std::string& where) {
        const auto attributes = primitive.find("attributes");
        if (attributes == primitive.end() || !attributes->is_object())
            gltf_.reject(where + ".attributes", "missing", "an object");
        std::optional<std::uint64_t> vertices;
        check_attributes(*attributes, where + ".attributes", vertices);
        if (const auto targets = primitive.find("targets"); targets != primitive.end()) {
            if (!targets->is_array()) gltf_.reject(where + ".targets", "is not an array", "one");
            for (std::size_t i = 0; i < targets->size(); ++i) {
                const std::string location = fmt::format("{}.targets[{}]", where, i);
                check_attributes(gltf_.object(*targets, i, location), location, vertices);
            }
        }
        gltf_.reference(primitive, where, "material", "materials");
        const std::uint64_t mode = gltf_.number(primitive, where, "mode", 6, 4);
        std::uint64_t corners = vertices.value_or(0);
        if (const auto indices = gltf_.reference(primitive, where, "indices", "accessors")) {
            corners = accessors_[*indices].count;
            check_indices(*indices, where, vertices.value_or(0));
        }
        constexpr std::uint64_t least[]{1, 2, 2, 2, 3, 3, 3};  // points, lines, line loop and strip, triangles ...
        if (vertices && corners < least[mode])
            gltf_.reject(where, fmt::format("has {} corners", corners), fmt::format("at least {}", least[mode]));
    }

  private:
    void check_attributes(const Json& attributes, const std::string& where, std::optional<std::uint64_t>& vertices) {
        for (const auto& [name, value] : attributes.items()) {
            const auto number = gltf_.reference(attributes, where, name.c_str(), "accessors");
            const GltfAccessor& accessor = accessors_[*number];
            const std::string location = where + "." + one_line(name);
            if (set_number(name).value_or(attributes.size()) >= attributes.size())
                gltf_.reject(location, "skips numbers of its set", "numbers that begin with 0 and follow each other");
            const bool has_floats = accessor.component_type == GltfAccessor::f32 ||
                                    (is_quantized_ && accessor.component_type < GltfAccessor::u32);
            if ((name == "POSITION" || name == "NORMAL") && (accessor.type != "VEC3" || !has_floats))
                gltf_.reject(location, "is not three floats", "VEC3 of component type 5126");
            if (vertices && accessor.count != *vertices)
                gltf_.reject(location, fmt::format("has {} elements", accessor.count),
                             fmt::format("{}, as the other attributes", *vertices));
            vertices = accessor.count;
        }
    }

    /// Accessors may be shared; caches the largest index of each.
    void check_indices(std::size_t number, const std::string& where, std::uint64_t vertices) {
        const GltfAccessor& accessor = accessors_[number];
        const unsigned type = accessor.component_type;
        if (accessor.type != "SCALAR" ||
            (type != GltfAccessor::u8 && type != GltfAccessor::u16 && type != GltfAccessor::u32))
            gltf_.reject(where + ".indices", fmt::format("is accessor {}, whose elements are not indices", number),
                         "SCALAR of component type 5121, 5123 or 5125");
        const auto [known, is_new] = largest_.emplace(number, 0);
        if (is_new) {
            const auto values = accessor.whole_numbers();
            known->second = *std::max_element(values.begin(), values.end());
        }
        if (known->second >= vertices)
            gltf_.reject(where + ".indices", fmt::format("has the vertex index {}", known->second),
                         fmt::format("less than {}, the number of vertices", vertices));
    }

    const Gltf& gltf_;
    const std::vector<GltfAccessor>& accessors_;
    bool is_quantized_ = false;  // whether positions and normals may be integers
    std::map<std::size_t, std::uint32_t> largest_;
};

constexpr std::size_t no_node = ~std::size_t{0};

/// Returns each node's parent. glTF requires "disjoint strict trees"; assimp copies a node per parent.
std::vector<std::size_t> find_parents(const Gltf& gltf, const Json& nodes) {
    std::vector<std::size_t> parent(nodes.size(), no_node);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::string where = fmt::format("nodes[{}]", i);
        const Json& node = gltf.object(nodes, i, where);
        gltf.reference(node, where, "mesh", "meshes");
        gltf.reference(node, where, "skin", "skins");
        gltf.reference(node, where, "camera", "cameras");
        const auto children = node.find("children");
        if (children == node.end()) continue;
        if (!children->is_array()) gltf.reject(where + ".children", "is not an array", "one");
        for (const Json& child : *children) {
            if (!child.is_number_unsigned() || child.get<std::uint64_t>() >= parent.size())
                gltf.reject(where, "has a child that does not exist", "the number of a node");
            std::size_t& known = parent[child.get<std::size_t>()];
            if (known != no_node)
                gltf.reject(fmt::format("nodes[{}]", child.get<std::size_t>()), "has two parents", "strict trees");
            known = i;
        }
    }
    return parent;
}

/// Rejects duplicate roots (copies). Accepts children as roots, which appear twice; some programs write them.
void check_scenes(const Gltf& gltf, std::size_t nodes) {
    const Json& scenes = gltf.list("scenes");
    if (scenes.empty()) gltf.reject("scenes", "is missing or empty", "a scene to show");
    gltf.reference(gltf.json, "document", "scene", "scenes");
    std::vector<std::size_t> named_by(nodes, scenes.size());
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const std::string where = fmt::format("scenes[{}]", i);
        const Json& scene = gltf.object(scenes, i, where);
        const auto roots = scene.find("nodes");
        if (roots == scene.end()) continue;
        if (!roots->is_array()) gltf.reject(where + ".nodes", "is not an array", "one");
        for (const Json& root : *roots) {
            if (!root.is_number_unsigned() || root.get<std::uint64_t>() >= nodes)
                gltf.reject(where, "has a node that does not exist", "the number of a node");
            const auto number = root.get<std::size_t>();
            if (named_by[number] == i) gltf.reject(where, fmt::format("names node {} twice", number), "each node once");
            named_by[number] = i;
        }
    }
}

}  // namespace

void check_primitives(const Gltf& gltf, const std::vector<GltfAccessor>& accessors) {
    Primitives primitives(gltf, accessors);
    const Json& meshes = gltf.list("meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const std::string where = fmt::format("meshes[{}]", i);
        const Json& mesh = gltf.object(meshes, i, where);
        const auto list = mesh.find("primitives");
        if (list == mesh.end() || !list->is_array()) gltf.reject(where + ".primitives", "missing", "an array");
        for (std::size_t k = 0; k < list->size(); ++k) {
            const std::string location = fmt::format("{}.primitives[{}]", where, k);
            primitives.check(gltf.object(*list, k, location), location);
        }
    }
}

void check_nodes(const Gltf& gltf) {
    constexpr std::size_t max_depth = 1000;
    const auto parent = find_parents(gltf, gltf.list("nodes"));
    // With at most one parent, a node is too deep or on a cycle if and only if its path upwards exceeds the limit.
    for (std::size_t i = 0; i < parent.size(); ++i) {
        std::size_t depth = 0;
        for (std::size_t node = i; node != no_node; node = parent[node])
            if (++depth > max_depth)
                gltf.reject(fmt::format("nodes[{}]", i), fmt::format("lies below more than {} others", max_depth),
                            "a flatter tree");
    }
    check_scenes(gltf, parent.size());
}

}  // namespace hogel::scene::mesh_files
