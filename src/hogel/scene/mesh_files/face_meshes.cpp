// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/face_meshes.h"

namespace hogel::scene::mesh_files {
namespace {

bool are_equal(const CornerAttributes& a, const CornerAttributes& b) {
    return a.coordinate.u == b.coordinate.u && a.coordinate.v == b.coordinate.v && a.color == b.color;
}

}  // namespace

Mesh& FaceMeshes::mesh(std::size_t picture) {
    const auto [found, is_new] = meshes_.try_emplace(picture);
    Mesh& mesh = found->second;
    if (!is_new) return mesh;
    mesh.material.base_color = {1, 1, 1};
    if (from_faces_.any()) return mesh;
    mesh.positions = vertices_.positions;
    mesh.normals = vertices_.normals;
    mesh.colors = vertices_.colors;
    mesh.texture_coordinates = vertices_.coordinates;
    return mesh;
}

std::uint32_t FaceMeshes::corner(std::size_t vertex, std::size_t picture, const CornerAttributes& attributes) {
    if (!from_faces_.any()) return static_cast<std::uint32_t>(vertex);
    constexpr int max_search = 32;  // bounds the time, which would be quadratic
    std::uint32_t copy = newest_[vertex];
    for (int i = 0; copy != none && i < max_search; copy = copies_[copy].older, ++i)
        if (copies_[copy].picture == picture && are_equal(copies_[copy].attributes, attributes))
            return copies_[copy].index;
    Mesh& to = mesh(picture);
    const auto index = static_cast<std::uint32_t>(to.positions.size());
    copies_.push_back({attributes, picture, index, newest_[vertex]});
    newest_[vertex] = static_cast<std::uint32_t>(copies_.size() - 1);
    append(vertex, attributes, to);
    return index;
}

void FaceMeshes::append(std::size_t vertex, const CornerAttributes& attributes, Mesh& to) const {
    const auto copy = [vertex](const auto& from, auto& list) {
        if (!from.empty()) list.push_back(from[vertex]);
    };
    copy(vertices_.positions, to.positions);
    copy(vertices_.normals, to.normals);
    // Attributes of faces replace those of vertices.
    if (from_faces_.colors)
        to.colors.push_back(attributes.color);
    else
        copy(vertices_.colors, to.colors);
    if (from_faces_.coordinates)
        to.texture_coordinates.push_back(attributes.coordinate);
    else
        copy(vertices_.coordinates, to.texture_coordinates);
}

}  // namespace hogel::scene::mesh_files
