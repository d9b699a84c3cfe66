// SPDX-License-Identifier: Apache-2.0
// Mesh instances: EXT_mesh_gpu_instancing.
#include <fmt/format.h>

#include <optional>

#include "hogel/scene/mesh_files/gltf.h"
#include "hogel/scene/mesh_files/gltf_materials.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::size_t max_instances = std::size_t{1} << 20;

struct Attribute {
    const char* name;      ///< in the extension
    const char* property;  ///< of a node
    const char* type;      ///< of the accessor
};
constexpr std::array attributes{Attribute{"TRANSLATION", "translation", "VEC3"},
                                Attribute{"ROTATION", "rotation", "VEC4"}, Attribute{"SCALE", "scale", "VEC3"}};

/// Returns a child node for each instance of a node.
std::vector<Json> instances_of(const Gltf& gltf, const Json& extension, const std::string& where, const Json& mesh,
                               const std::vector<GltfAccessor>& accessors) {
    static const Json none = Json::object();
    const Json* attribute_accessors = find_object(gltf, extension, where, {"attributes"});
    if (attribute_accessors == nullptr) attribute_accessors = &none;
    std::vector<Json> instances;
    std::optional<std::uint64_t> count;
    for (const Attribute& attribute : attributes) {
        const auto number = gltf.reference(*attribute_accessors, where + ".attributes", attribute.name, "accessors");
        if (!number) continue;
        const GltfAccessor& accessor = accessors[*number];
        const std::string location = where + ".attributes." + attribute.name;
        if (accessor.type != attribute.type) gltf.reject(location, "is " + accessor.type, attribute.type);
        if (count && accessor.count != *count)
            gltf.reject(location, fmt::format("has {} elements", accessor.count),
                        fmt::format("{}, as the other attributes", *count));
        if (accessor.count > max_instances)
            gltf.reject(location, fmt::format("has {} elements", accessor.count),
                        fmt::format("at most {}", max_instances));
        count = accessor.count;
        instances.resize(accessor.count, Json{{"mesh", mesh}});
        const std::vector<float> values = accessor.floats(true);  // the only integer attributes are rotations
        const std::size_t size = values.size() / accessor.count;
        for (std::size_t i = 0; i < accessor.count; ++i)
            instances[i][attribute.property] =
                std::vector<float>(values.begin() + static_cast<std::ptrdiff_t>(i * size),
                                   values.begin() + static_cast<std::ptrdiff_t>((i + 1) * size));
    }
    if (!count) gltf.reject(where + ".attributes", "has no place of an instance", "TRANSLATION, ROTATION or SCALE");
    return instances;
}

}  // namespace

void place_instances(Gltf& gltf, const std::vector<GltfAccessor>& accessors) {
    const std::size_t nodes = gltf.list("nodes").size();
    for (std::size_t i = 0; i < nodes; ++i) {
        const std::string where = fmt::format("nodes[{}]", i);
        const Json& node = gltf.json["nodes"][i];
        const Json* extension = find_object(gltf, node, where, {"extensions", "EXT_mesh_gpu_instancing"});
        if (extension == nullptr || !node.contains("mesh")) continue;
        std::vector<Json> instances =
            instances_of(gltf, *extension, where + ".extensions.EXT_mesh_gpu_instancing", node["mesh"], accessors);
        Json& all_nodes = gltf.json["nodes"];
        if (all_nodes.size() + instances.size() > nodes + max_instances)
            gltf.reject(where, "has too many instances with those before it", fmt::format("at most {}", max_instances));
        all_nodes[i].erase("mesh");
        for (Json& instance : instances) {
            all_nodes[i]["children"].push_back(all_nodes.size());
            all_nodes.push_back(std::move(instance));
        }
    }
}

}  // namespace hogel::scene::mesh_files
