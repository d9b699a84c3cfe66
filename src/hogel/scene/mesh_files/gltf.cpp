// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "hogel/core/json.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/draco.h"
#include "hogel/scene/mesh_files/gltf_materials.h"
#include "hogel/scene/mesh_files/meshopt.h"

namespace hogel::scene::mesh_files {
namespace {

// Extensions that a file may require: supported, or reported in a note. No compressed pictures.
constexpr std::array supported_extensions{
    "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression",   "EXT_texture_webp",
    "KHR_draco_mesh_compression", "KHR_lights_punctual",       "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",    "KHR_materials_dispersion",  "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_iridescence", "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",        "KHR_materials_specular",    "KHR_materials_transmission",
    "KHR_materials_unlit",        "KHR_materials_variants",    "KHR_materials_volume",
    "KHR_mesh_quantization",      "KHR_texture_transform",     "KHR_xmp_json_ld"};

std::uint32_t read_u32(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;  // little-endian, like this machine
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// Formats a value for a message.
std::string shown(const Json& value) {
    constexpr std::size_t longest = 40;
    if (value.is_structured()) return value.is_array() ? "an array" : "an object";
    const std::string text = one_line(value.dump());
    return text.size() > longest ? text.substr(0, longest) + " ..." : text;
}

/// Returns the JSON part. Throws unless .glb chunks are inside the file: assimp allocates their stated sizes.
std::string_view split_chunks(std::string_view bytes, Gltf& gltf) {
    gltf.is_binary = bytes.starts_with("glTF");
    if (!gltf.is_binary) return bytes;
    if (bytes.size() < 12) reject_file(gltf.file, "ends in its header", "a .glb file");
    const std::uint32_t length = read_u32(bytes, 8);
    if (length > bytes.size())
        reject_file(gltf.file, fmt::format("has {} bytes and announces {}", bytes.size(), length), "a complete file");
    if (read_u32(bytes, 4) != 2)
        reject_file(gltf.file, fmt::format("is a .glb file of version {}", read_u32(bytes, 4)), "version 2");
    std::string_view json;
    std::size_t chunk = 0;
    for (std::size_t offset = 12; offset < bytes.size(); ++chunk) {
        const std::size_t remaining = bytes.size() - offset;
        const std::uint32_t size = remaining >= 8 ? read_u32(bytes, offset) : 0;
        if (remaining < 8 || size > remaining - 8)
            reject_file(gltf.file, fmt::format("a chunk of {} bytes at byte {}", size, offset),
                        "one that ends in the file");
        const std::string_view type = bytes.substr(offset + 4, 4), content = bytes.substr(offset + 8, size);
        if (chunk == 0 && (type != "JSON" || size % 4 != 0))
            reject_file(gltf.file, "does not begin with a JSON chunk of whole words", "a .glb file");
        if (chunk == 0) json = content;
        if (chunk == 1 && type == std::string_view("BIN\0", 4)) {
            gltf.binary = content;
            gltf.has_binary = true;
        }
        offset += 8 + std::size_t{size};
    }
    return json;
}

void check_version(Gltf& gltf) {
    const auto asset = gltf.json.find("asset");
    if (asset == gltf.json.end() || !asset->is_object() || !asset->contains("version") ||
        !(*asset)["version"].is_string())
        gltf.reject("asset.version", "missing", "\"2.0\"");
    const std::string version = (*asset)["version"];
    if (version.starts_with("1.")) return;
    if (!version.starts_with("2.")) gltf.reject("asset.version", "is " + shown(version), "\"2.0\"");
    if (const auto least = asset->find("minVersion"); least != asset->end() && *least != "2.0")
        gltf.reject("asset.minVersion", "is " + shown(*least), "\"2.0\"");
    gltf.is_version_2 = true;
}

void check_extensions(const Gltf& gltf) {
    for (const Json& name : gltf.list("extensionsRequired"))
        if (std::find(supported_extensions.begin(), supported_extensions.end(), name) == supported_extensions.end())
            gltf.reject("extensionsRequired", fmt::format("names {}, which hogel cannot read", shown(name)),
                        "a file that needs no such extension; convert it, for instance without compression");
}

/// Removes the parts that assimp must not read (see read_materials()). assimp crashes on skins without optional parts,
/// and reorders materials: their names become their indices.
void drop_unused(Json& json) {
    for (const char* name : {"animations", "cameras", "skins", "textures", "images", "samplers", "extensions",
                             "extensionsUsed", "extensionsRequired"})
        json.erase(name);
    if (json.contains("nodes"))
        for (Json& node : json["nodes"])
            for (const char* name : {"camera", "skin", "weights", "extensions"}) node.erase(name);
    if (json.contains("materials"))
        for (std::size_t i = 0; i < json["materials"].size(); ++i)
            json["materials"][i] = {{"name", numbered_material(i)}};
    if (!json.contains("meshes")) return;
    for (Json& mesh : json["meshes"]) {
        mesh.erase("weights");
        for (Json& primitive : mesh["primitives"]) {
            primitive.erase("targets");
            primitive.erase("extensions");
        }
    }
}

/// Returns the texts in asset.extras.hogel; ignores other contents.
Metadata stored_provenance(const Json& json) {
    Metadata provenance;
    const Json::json_pointer location("/asset/extras/hogel");
    if (!json.contains(location) || !json[location].is_object()) return provenance;
    for (const auto& [key, text] : json[location].items())
        if (text.is_string()) provenance.emplace_back(key, text.get<std::string>());
    return provenance;
}

void append_chunk(std::string& bytes, std::string_view type, std::string_view content) {
    const auto size = static_cast<std::uint32_t>(content.size());
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size).append(type).append(content);
}

/// Reassembles the file, as .glb if it was one.
std::string assemble(const Gltf& gltf) {
    std::string json = gltf.json.dump();
    if (!gltf.is_binary) return json;
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::uint32_t version = 2;
    const auto size = static_cast<std::uint32_t>(20 + json.size() + (gltf.has_binary ? 8 + gltf.binary.size() : 0));
    std::string bytes = "glTF";
    bytes.append(reinterpret_cast<const char*>(&version), sizeof version);
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    append_chunk(bytes, "JSON", json);
    if (gltf.has_binary) append_chunk(bytes, {"BIN\0", 4}, gltf.binary);
    return bytes;
}

}  // namespace

std::string numbered_material(std::size_t number) { return fmt::format("material {}", number); }

std::optional<std::size_t> material_number(std::string_view name) {
    constexpr std::string_view start = "material ";
    std::size_t number = 0;
    if (!name.starts_with(start)) return std::nullopt;
    const auto [end, status] = std::from_chars(name.data() + start.size(), name.data() + name.size(), number);
    if (status != std::errc{} || end != name.data() + name.size()) return std::nullopt;
    return number;
}

bool is_known_extension(const std::string& name) {
    // For KHR_texture_basisu the document contains the fallback.
    return std::ranges::count(supported_extensions, name) > 0 || name == "KHR_texture_basisu";
}

void Gltf::reject(const std::string& where, const std::string& what, const std::string& expected) const {
    reject_file(file, where + " " + what, expected);
}

const Json& Gltf::list(const char* name) const {
    static const Json empty = Json::array();
    const auto found = json.find(name);
    if (found == json.end()) return empty;
    if (!found->is_array()) reject(name, "is " + shown(*found), "an array");
    return *found;
}

const Json& Gltf::object(const Json& array, std::size_t i, const std::string& where) const {
    if (!array[i].is_object()) reject(where, "is " + shown(array[i]), "an object");
    return array[i];
}

std::uint64_t Gltf::number(const Json& object, const std::string& where, const char* name, std::uint64_t max,
                           std::optional<std::uint64_t> fallback) const {
    const auto found = object.find(name);
    const std::string location = where + "." + name;
    if (found == object.end()) {
        if (!fallback) reject(location, "missing", "a whole number");
        return *fallback;
    }
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() > max)
        reject(location, "is " + shown(*found), fmt::format("a whole number from 0 to {}", max));
    return *found;
}

std::optional<std::size_t> Gltf::reference(const Json& object, const std::string& where, const char* name,
                                           const char* list_name) const {
    const auto found = object.find(name);
    if (found == object.end()) return std::nullopt;
    const std::size_t size = list(list_name).size();
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() >= size)
        reject(fmt::format("{}.{}", where, name), "is " + shown(*found),
               fmt::format("the number of one of {} {}", size, list_name));
    return found->get<std::size_t>();
}

Gltf parse_gltf(const std::string& file, const std::filesystem::path& folder, std::string_view bytes) {
    Gltf gltf;
    gltf.file = file;
    gltf.folder = folder;
    gltf.file_size = bytes.size();
    gltf.json = core::parse_json(split_chunks(bytes, gltf),
                                 [&](const std::string& fault) { reject_file(file, fault, "a glTF document"); });
    if (!gltf.json.is_object()) reject_file(file, "its JSON is " + shown(gltf.json), "an object: a glTF document");
    check_version(gltf);
    if (gltf.is_version_2) check_extensions(gltf);
    return gltf;
}

// assimp 5.2 drops faces with bad indices, wraps offsets, allocates untrusted counts and recurses over trees.
CheckedGltf check_gltf(const std::string& file, const std::filesystem::path& folder, std::string_view bytes) {
    Gltf gltf = parse_gltf(file, folder, bytes);
    if (!gltf.is_version_2) return {};
    unpack_views(gltf);
    unpack_draco(gltf);
    CheckedGltf checked;
    checked.provenance = stored_provenance(gltf.json);
    {
        const GltfBuffers buffers(gltf);
        const std::vector<GltfAccessor> accessors = check_accessors(gltf, buffers);
        check_primitives(gltf, accessors);
        check_nodes(gltf);
        checked.materials = read_materials(gltf, buffers);
        place_instances(gltf, accessors);
        make_floats(gltf, accessors);
    }
    drop_unused(gltf.json);
    checked.contents = assemble(gltf);
    return checked;
}

}  // namespace hogel::scene::mesh_files
