// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/gltf_materials.h"

namespace hogel::scene::mesh_files {
namespace {

/// An affine map: the images of the axes, and of the origin.
struct Affine {
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 origin{0, 0, 0};

    Vec3 turned(Vec3 v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
    Affine operator*(const Affine& inner) const {
        return {{turned(inner.axes[0]), turned(inner.axes[1]), turned(inner.axes[2])}, origin + turned(inner.origin)};
    }
};

Affine transform_of(const Gltf& gltf, const Json& node, const std::string& where) {
    if (node.contains("matrix")) {
        const auto m = numbers_or(gltf, node, where, "matrix", std::vector<double>(16));
        return {{Vec3{m[0], m[1], m[2]}, Vec3{m[4], m[5], m[6]}, Vec3{m[8], m[9], m[10]}}, Vec3{m[12], m[13], m[14]}};
    }
    const auto t = numbers_or(gltf, node, where, "translation", {0, 0, 0});
    const auto q = numbers_or(gltf, node, where, "rotation", {0, 0, 0, 1});
    const auto s = numbers_or(gltf, node, where, "scale", {1, 1, 1});
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return {{s[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
             s[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
             s[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}},
            {t[0], t[1], t[2]}};
}

/// Returns the unit viewing or light direction of a node.
Vec3 forward(const Gltf& gltf, const std::string& where, const Affine& to_world) {
    const Vec3 direction = -to_world.axes[2];
    if (!(length(direction) > 0)) gltf.reject(where, "has no direction", "a node that is not flat");
    return normalize(direction);
}

void read_cone(const Gltf& gltf, const Json& json, const std::string& where, const Affine& to_world, Light& light) {
    static const Json none = Json::object();
    const Json* spot = find_object(gltf, json, where, {"spot"});
    const std::string location = where + ".spot";
    constexpr double right = std::numbers::pi / 2;
    light.direction = forward(gltf, where, to_world);
    light.outer_cone =
        std::clamp(number_or(gltf, spot ? *spot : none, location, "outerConeAngle", right / 2), 0.0, right);
    light.inner_cone =
        std::clamp(number_or(gltf, spot ? *spot : none, location, "innerConeAngle", 0), 0.0, light.outer_cone);
}

SceneCamera read_camera(const Gltf& gltf, const Json& json, const std::string& where, const Json& node,
                        const Affine& to_world) {
    SceneCamera camera;
    for (const Json* named : {&node, &json})
        if (const auto name = named->find("name"); camera.name.empty() && name != named->end() && name->is_string())
            camera.name = one_line(*name);
    camera.position = to_world.origin;
    const Vec3 ahead = forward(gltf, where, to_world), side = cross(ahead, to_world.axes[1]);
    if (!(length(side) > 0)) gltf.reject(where, "has no upward direction", "a node that is not flat");
    camera.right = normalize(side);
    camera.up = cross(camera.right, ahead);
    const auto positive_value = [&](const char* name, const char* part) {
        const Json* object = find_object(gltf, json, where, {name});
        const std::string location = where + "." + name;
        if (object == nullptr) gltf.reject(location, "missing", "an object");
        camera.nearest = std::max(0.0, number_or(gltf, *object, location, "znear", 0));
        const double value = number_or(gltf, *object, location, part, 0);
        if (!(value > 0)) gltf.reject(location + "." + part, "is not above zero", "a positive number");
        return value;
    };
    const auto type = json.find("type");
    if (type != json.end() && *type == "perspective") {
        camera.angle = positive_value("perspective", "yfov");
        if (!(camera.angle < std::numbers::pi)) gltf.reject(where + ".perspective.yfov", "is π or more", "less");
    } else if (type != json.end() && *type == "orthographic") {
        camera.height = 2 * positive_value("orthographic", "ymag") * length(to_world.axes[1]);
    } else {
        gltf.reject(where + ".type", "is unknown", "perspective or orthographic");
    }
    camera.nearest *= length(to_world.axes[2]);
    return camera;
}

Light read_light(const Gltf& gltf, const Json& json, const std::string& where, const Affine& to_world,
                 GltfMaterials& materials) {
    const auto color = numbers_or(gltf, json, where, "color", {1, 1, 1});
    const double intensity = std::clamp(number_or(gltf, json, where, "intensity", 1), 0.0, 1e9);
    Light light;
    const auto part = [&](std::size_t i) { return static_cast<float>(intensity * std::clamp(color[i], 0.0, 1e3)); };
    light.intensity = {part(0), part(1), part(2)};
    const auto type = json.find("type");
    if (json.contains("range"))
        materials.notes.push_back(
            fmt::format("{} has a range, which is left out: its light reaches everywhere", where));
    const bool is_spot = type != json.end() && *type == "spot";
    if (is_spot || (type != json.end() && *type == "point")) {
        light.kind = Light::Kind::point;
        light.position = to_world.origin;
        if (is_spot) read_cone(gltf, json, where, to_world, light);
    } else if (type != json.end() && *type == "directional") {
        light.kind = Light::Kind::directional;
        light.direction = forward(gltf, where, to_world);
    } else {
        gltf.reject(where + ".type", "is unknown", "directional, point or spot");
    }
    return light;
}

/// Visits the nodes of the displayed scene with their transforms. Nodes are strict trees (check_nodes()).
template <class Visit>
void for_nodes(const Gltf& gltf, const Visit& visit) {
    const Json &scenes = gltf.list("scenes"), &nodes = gltf.list("nodes");
    if (scenes.empty()) return;
    const std::size_t shown = gltf.reference(gltf.json, "document", "scene", "scenes").value_or(0);
    struct Todo {
        std::size_t node;
        Affine parent;
    };
    std::vector<Todo> todo;
    const auto add = [&](const Json& owner, const char* name, const Affine& parent) {
        if (const auto list = owner.find(name); list != owner.end())
            for (std::size_t i = list->size(); i-- > 0;)  // reversed: the first is on top
                todo.push_back({(*list)[i].get<std::size_t>(), parent});
    };
    add(scenes[shown], "nodes", {});
    while (!todo.empty()) {
        const Todo current = todo.back();
        todo.pop_back();
        const std::string where = fmt::format("nodes[{}]", current.node);
        const Json& node = nodes[current.node];
        const Affine to_world = current.parent * transform_of(gltf, node, where);
        visit(node, where, to_world);
        add(node, "children", to_world);
    }
}

/// Adds a note for each unsupported material feature, with the number of materials.
void note_materials(const Gltf& gltf, GltfMaterials& materials) {
    static const std::map<std::string, std::string> names{
        {"KHR_materials_anisotropy", "anisotropy (KHR_materials_anisotropy)"},
        {"KHR_materials_clearcoat", "clear coats (KHR_materials_clearcoat)"},
        {"KHR_materials_dispersion", "dispersion (KHR_materials_dispersion)"},
        {"KHR_materials_iridescence", "iridescence (KHR_materials_iridescence)"},
        {"KHR_materials_sheen", "sheen (KHR_materials_sheen)"},
        {"KHR_materials_transmission", "transmission (KHR_materials_transmission)"},
        {"KHR_materials_volume", "volumes (KHR_materials_volume)"}};
    std::map<std::string, std::size_t> counts;
    for (const Json& material : gltf.list("materials")) {
        const auto count = [&](const Json& object) {
            for (const auto& [name, text] : names) counts[text] += object.contains(name) ? 1 : 0;
        };
        count(material);
        if (const auto extensions = material.find("extensions");
            extensions != material.end() && extensions->is_object()) {
            count(*extensions);
            const auto has = [&](const char* extension, std::initializer_list<const char*> parts) {
                const auto object = extensions->find(extension);
                return object != extensions->end() &&
                       std::ranges::any_of(parts, [&](const char* part) { return object->contains(part); });
            };
            if (has("KHR_materials_specular", {"specularTexture", "specularColorTexture", "specularColorFactor"}))
                ++counts["specular colours and textures (KHR_materials_specular)"];
            if (has("KHR_materials_pbrSpecularGlossiness", {"specularGlossinessTexture"}))
                ++counts["specular-glossiness textures (KHR_materials_pbrSpecularGlossiness)"];
        }
    }
    for (const auto& [text, count] : counts)
        if (count > 0)
            materials.notes.push_back(
                fmt::format("{} of {} material{} are left out", text, count, count == 1 ? "" : "s"));
}

void note_geometry(const Gltf& gltf, GltfMaterials& materials) {
    std::size_t thin = 0, morphed = 0;
    for (const Json& mesh : gltf.list("meshes"))
        for (const Json& primitive : mesh["primitives"]) {
            const auto mode = primitive.find("mode");
            thin += mode != primitive.end() && mode->get<std::uint64_t>() < 4 ? 1 : 0;
            morphed += primitive.contains("targets") ? 1 : 0;
        }
    if (thin > 0) materials.notes.push_back(fmt::format("{} primitives of points or lines are left out", thin));
    if (morphed > 0)
        materials.notes.push_back("morph targets are left out: meshes have the shape that they begin with");
    if (!gltf.list("skins").empty())
        materials.notes.push_back("skins are left out: meshes have the pose in which they were modelled");
    if (!gltf.list("animations").empty()) materials.notes.push_back("animations are left out: it stands still");
}

}  // namespace

void read_lights(const Gltf& gltf, GltfMaterials& materials) {
    for_nodes(gltf, [&](const Json& node, const std::string& where, const Affine& to_world) {
        const auto number = gltf.reference(node, where, "camera", "cameras");
        if (!number) return;
        const std::string camera = fmt::format("cameras[{}]", *number);
        const Json& json = gltf.object(gltf.list("cameras"), *number, camera);
        materials.cameras.push_back(read_camera(gltf, json, camera, node, to_world));
    });
    const Json* extension = find_object(gltf, gltf.json, "document", {"extensions", "KHR_lights_punctual"});
    if (extension == nullptr) return;
    const auto list = extension->find("lights");
    if (list == extension->end() || !list->is_array())
        gltf.reject("extensions.KHR_lights_punctual.lights", "missing", "an array");
    for_nodes(gltf, [&](const Json& node, const std::string& where, const Affine& to_world) {
        const Json* light_reference = find_object(gltf, node, where, {"extensions", "KHR_lights_punctual"});
        if (light_reference == nullptr) return;
        const std::string location = where + ".extensions.KHR_lights_punctual";
        if (list->empty()) gltf.reject(location, "names a light", "lights in the document");
        const std::uint64_t number = gltf.number(*light_reference, location, "light", list->size() - 1);
        const std::string light = fmt::format("lights[{}]", number);
        materials.lights.push_back(read_light(gltf, gltf.object(*list, number, light), light, to_world, materials));
    });
}

void note_what_is_left_out(const Gltf& gltf, GltfMaterials& materials) {
    note_materials(gltf, materials);
    note_geometry(gltf, materials);
    if (find_object(gltf, gltf.json, "document", {"extensions", "KHR_materials_variants"}) != nullptr)
        materials.notes.push_back("variants of materials (KHR_materials_variants) are left out: the first is shown");
    std::set<std::string> unknown;
    for (const Json& name : gltf.list("extensionsUsed"))
        if (name.is_string() && !is_known_extension(name.get<std::string>())) unknown.insert(one_line(name));
    if (!unknown.empty())
        materials.notes.push_back(
            fmt::format("extensions that hogel does not know are left out: {}", fmt::join(unknown, ", ")));
}

}  // namespace hogel::scene::mesh_files
