// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/draco.h"

#include <draco/compression/decode.h>

#include <array>
#include <memory>

namespace hogel::scene::mesh_files {
namespace {

template <class T>
bool append_elements(const draco::Mesh& mesh, const draco::PointAttribute& from, std::size_t components,
                     std::string& bytes) {
    constexpr std::size_t max_components = 4;
    if (components > max_components) return false;
    std::array<T, max_components> element{};
    for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
        if (!from.ConvertValue<T>(from.mapped_index(i), static_cast<std::int8_t>(components), element.data()))
            return false;
        bytes.append(reinterpret_cast<const char*>(element.data()), components * sizeof(T));
    }
    return true;
}

bool append_attribute(const draco::Mesh& mesh, const DracoMesh::Values& values, std::string& bytes) {
    const draco::PointAttribute* from = mesh.GetAttributeByUniqueId(values.id);
    if (from == nullptr || values.count != mesh.num_points()) return false;
    switch (values.component_type) {
        case 5120:
            return append_elements<std::int8_t>(mesh, *from, values.components, bytes);
        case GltfAccessor::u8:
            return append_elements<std::uint8_t>(mesh, *from, values.components, bytes);
        case 5122:
            return append_elements<std::int16_t>(mesh, *from, values.components, bytes);
        case GltfAccessor::u16:
            return append_elements<std::uint16_t>(mesh, *from, values.components, bytes);
        case GltfAccessor::u32:
            return append_elements<std::uint32_t>(mesh, *from, values.components, bytes);
        default:
            return append_elements<float>(mesh, *from, values.components, bytes);
    }
}

template <class T>
void append_indices(const draco::Mesh& mesh, std::string& bytes) {
    for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i)
        for (const draco::PointIndex& corner : mesh.face(i)) {
            const auto index = static_cast<T>(corner.value());
            bytes.append(reinterpret_cast<const char*>(&index), sizeof index);
        }
}

}  // namespace

std::optional<std::vector<std::string>> decode(const DracoMesh& mesh) {
    draco::DecoderBuffer buffer;
    buffer.Init(mesh.packed.data(), mesh.packed.size());
    draco::Decoder decoder;
    const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return std::nullopt;
    const draco::Mesh& from = *decoded.value();
    std::vector<std::string> lists;
    for (const DracoMesh::Values& attribute : mesh.attributes)
        if (!append_attribute(from, attribute, lists.emplace_back())) return std::nullopt;
    if (!mesh.indices) return lists;
    if (mesh.indices->count != 3 * std::uint64_t{from.num_faces()}) return std::nullopt;
    std::string& indices = lists.emplace_back();
    if (mesh.indices->component_type == GltfAccessor::u8)
        append_indices<std::uint8_t>(from, indices);
    else if (mesh.indices->component_type == GltfAccessor::u16)
        append_indices<std::uint16_t>(from, indices);
    else
        append_indices<std::uint32_t>(from, indices);
    return lists;
}

}  // namespace hogel::scene::mesh_files
