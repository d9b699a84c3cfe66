// SPDX-License-Identifier: Apache-2.0
// Decoding of KHR_draco_mesh_compression.
#include <fmt/format.h>

#include "hogel/core/child_process.h"
#include "hogel/core/part.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/draco.h"
#include "hogel/scene/mesh_files/gltf_materials.h"
#include "hogel/scene/mesh_files/limits.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr const char* draco_extension = "KHR_draco_mesh_compression";

/// A primitive with accessors without data.
struct PackedPrimitive {
    std::string where;
    DracoMesh mesh;
    std::vector<std::size_t> accessors;  ///< of the attributes, followed by that of the indices

    std::uint64_t bytes(std::size_t list) const {
        const DracoMesh::Values& values = list < mesh.attributes.size() ? mesh.attributes[list] : mesh.indices.value();
        return values.count * values.components * component_size(values.component_type);
    }
    std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < accessors.size(); ++i) sum += bytes(i);
        return sum;
    }
};

DracoMesh::Values values_of(const Gltf& gltf, std::size_t accessor) {
    const std::string where = fmt::format("accessors[{}]", accessor);
    const GltfAccessor type = read_accessor_type(gltf, gltf.object(gltf.list("accessors"), accessor, where), where);
    return {type.component_type, type.element_size / type.component_size, type.count, 0};
}

std::string_view packed_bytes(const Gltf& gltf, const GltfBuffers& buffers, const Json& packed,
                              const std::string& where) {
    const auto number = gltf.reference(packed, where, "bufferView", "bufferViews");
    if (!number) gltf.reject(where + ".bufferView", "missing", "the number of a view");
    const std::string location = fmt::format("bufferViews[{}]", *number);
    const Json& view = gltf.object(gltf.list("bufferViews"), *number, location);
    const auto buffer = gltf.reference(view, location, "buffer", "buffers");
    if (!buffer) gltf.reject(location + ".buffer", "missing", "the number of a buffer");
    const std::string_view data = buffers[*buffer];
    const std::uint64_t offset = gltf.number(view, location, "byteOffset", data.size(), 0);
    return data.substr(offset, gltf.number(view, location, "byteLength", data.size() - offset));
}

PackedPrimitive read_primitive(const Gltf& gltf, const GltfBuffers& buffers, const Json& primitive, const Json& packed,
                               const std::string& outer) {
    const std::string where = fmt::format("{}.extensions.{}", outer, draco_extension);
    PackedPrimitive read{where, {packed_bytes(gltf, buffers, packed, where), {}, {}}, {}};
    const auto ids = packed.find("attributes");
    if (ids == packed.end() || !ids->is_object()) gltf.reject(where + ".attributes", "missing", "an object");
    for (const auto& [name, id] : ids->items()) {
        const auto accessor = gltf.reference(primitive["attributes"], outer + ".attributes", name.c_str(), "accessors");
        if (!accessor) gltf.reject(where + ".attributes", "has " + one_line(name), "attributes of the primitive");
        DracoMesh::Values values = values_of(gltf, *accessor);
        values.id = static_cast<std::uint32_t>(gltf.number(*ids, where, name.c_str(), ~std::uint32_t{0}));
        read.mesh.attributes.push_back(values);
        read.accessors.push_back(*accessor);
    }
    if (const auto indices = gltf.reference(primitive, outer, "indices", "accessors")) {
        read.mesh.indices = values_of(gltf, *indices);
        read.accessors.push_back(*indices);
    }
    return read;
}

bool has_data(const Gltf& gltf, const Json& primitive) {
    const Json& accessors = gltf.list("accessors");
    const auto lacks = [&](const Json& number) {
        return number.is_number_unsigned() && number.get<std::uint64_t>() < accessors.size() &&
               accessors[number.get<std::size_t>()].is_object() &&
               !accessors[number.get<std::size_t>()].contains("bufferView");
    };
    if (const auto indices = primitive.find("indices"); indices != primitive.end() && lacks(*indices)) return false;
    for (const Json& number : primitive["attributes"])
        if (lacks(number)) return false;
    return true;
}

/// Calls `visit` with each compressed primitive, its extension, and its position.
template <class Visit>
void for_packed(const Gltf& gltf, const Visit& visit) {
    const Json& meshes = gltf.list("meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const auto list = gltf.object(meshes, i, fmt::format("meshes[{}]", i)).find("primitives");
        if (list == meshes[i].end() || !list->is_array()) continue;  // check_primitives() rejects it
        for (std::size_t k = 0; k < list->size(); ++k) {
            const std::string where = fmt::format("meshes[{}].primitives[{}]", i, k);
            const Json& primitive = gltf.object(*list, k, where);
            const Json* packed = find_object(gltf, primitive, where, {"extensions", draco_extension});
            const auto attributes = primitive.find("attributes");
            if (packed && attributes != primitive.end() && attributes->is_object()) visit(primitive, *packed, where);
        }
    }
}

std::vector<std::vector<std::string>> decode_in_child(const Gltf& gltf,
                                                      const std::vector<PackedPrimitive>& primitives) {
    std::uint64_t bytes = 0;
    for (const PackedPrimitive& primitive : primitives) bytes += primitive.mesh.packed.size();
    const auto work = [&](int pipe) {
        for (const PackedPrimitive& primitive : primitives) {
            const auto lists = decode(primitive.mesh);
            const char is_whole = lists ? 1 : 0;
            core::ChildProcess::write(pipe, &is_whole, 1);
            if (!lists) return;
            for (const std::string& list : *lists) core::ChildProcess::write(pipe, list.data(), list.size());
        }
    };
    const auto receive = [&](core::ChildProcess& child) {
        std::vector<std::vector<std::string>> decoded;
        for (const PackedPrimitive& primitive : primitives) {
            char is_whole = 0;
            child.read(&is_whole, 1);
            if (is_whole == 0)
                gltf.reject(primitive.where, "is damaged or holds other numbers of vertices and indices",
                            "a stream of what its accessors announce");
            std::vector<std::string>& lists = decoded.emplace_back();
            for (std::size_t i = 0; i < primitive.accessors.size(); ++i) {
                lists.emplace_back(primitive.bytes(i), '\0');
                child.read(lists.back().data(), lists.back().size());
            }
        }
        return decoded;
    };
    try {
        return core::with_child(child_limits(bytes), work, receive);
    } catch (const core::ChildFailure& failure) {
        reject_file(gltf.file, fmt::format("the decoder of {} {}", draco_extension, failure.what()),
                    "an undamaged mesh file");
    }
}

void set_data(Gltf& gltf, std::size_t accessor, const std::string& bytes) {
    Json& views = gltf.json["bufferViews"];
    Json& object = gltf.json["accessors"][accessor];
    object["bufferView"] = views.size();
    object.erase("byteOffset");
    views.push_back({{"buffer", gltf.json["buffers"].size()}, {"byteLength", bytes.size()}});
    gltf.json["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}});
}

}  // namespace

void unpack_draco(Gltf& gltf) {
    bool any = false;
    for_packed(gltf,
               [&](const Json& primitive, const Json&, const std::string&) { any |= !has_data(gltf, primitive); });
    if (!any) return;
    std::vector<PackedPrimitive> primitives;
    std::vector<std::vector<std::string>> lists;
    {
        const GltfBuffers buffers(gltf);
        std::uint64_t sum = 0;
        for_packed(gltf, [&](const Json& primitive, const Json& packed, const std::string& where) {
            if (has_data(gltf, primitive)) return;
            core::require_part("Draco", fmt::format("{}: {} is packed by {}", gltf.file, where, draco_extension));
            primitives.push_back(read_primitive(gltf, buffers, primitive, packed, where));
            sum += primitives.back().bytes();
            // Primitives may share a stream.
            if (sum > max_scene_bytes(gltf.file_size))
                gltf.reject(
                    where, fmt::format("and those before it announce {} bytes", sum),
                    fmt::format("at most {} for a file of {} bytes", max_scene_bytes(gltf.file_size), gltf.file_size));
        });
        lists = decode_in_child(gltf, primitives);
    }
    for (std::size_t i = 0; i < primitives.size(); ++i)
        for (std::size_t k = 0; k < primitives[i].accessors.size(); ++k)
            set_data(gltf, primitives[i].accessors[k], lists[i][k]);
}

}  // namespace hogel::scene::mesh_files
