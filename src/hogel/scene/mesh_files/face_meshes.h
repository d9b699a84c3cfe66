// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "hogel/scene.h"
#include "hogel/scene/mesh_files/points.h"

namespace hogel::scene::mesh_files {

/// Vertices that the faces of a file refer to by index.
struct Vertices : Points {
    std::vector<TextureCoordinate> coordinates;  ///< empty or as long as `positions`
};

/// Attributes that a face assigns to one of its corners.
struct CornerAttributes {
    TextureCoordinate coordinate;
    Rgb color;  ///< linear
};

/// Kinds of attributes that faces assign to their vertices.
struct FaceAttributes {
    bool coordinates = false, colors = false, pictures = false;

    bool any() const { return coordinates || colors || pictures; }
};

/// Builder of one mesh per texture picture of a file. If faces have no attributes, a mesh has all vertices of the file
/// in order; otherwise only those that its faces use. A vertex is copied for each combination of picture, colour and
/// texture coordinates that faces give it.
class FaceMeshes {
  public:
    /// @param vertices  must outlive this
    FaceMeshes(const Vertices& vertices, FaceAttributes from_faces)
        : vertices_(vertices),
          from_faces_(from_faces),
          newest_(from_faces.any() ? vertices.positions.size() : 0, none) {}

    /// Returns the mesh of a picture; creates a white one at the first call.
    Mesh& mesh(std::size_t picture);
    /// Returns the index in mesh(picture) of an existing vertex of the file.
    std::uint32_t corner(std::size_t vertex, std::size_t picture, const CornerAttributes& attributes);
    std::map<std::size_t, Mesh>& meshes() { return meshes_; }

  private:
    void append(std::size_t vertex, const CornerAttributes& attributes, Mesh& to) const;

    static constexpr std::uint32_t none = ~std::uint32_t{0};
    struct Copy {
        CornerAttributes attributes;
        std::size_t picture;
        std::uint32_t index;  ///< in the picture's mesh
        std::uint32_t older;  ///< previous copy of the same vertex
    };
    const Vertices& vertices_;
    FaceAttributes from_faces_;
    std::map<std::size_t, Mesh> meshes_;
    std::vector<std::uint32_t> newest_;  ///< latest copy of each vertex of the file
    std::vector<Copy> copies_;
};

}  // namespace hogel::scene::mesh_files
