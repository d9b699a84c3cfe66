// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "hogel/scene.h"
#include "hogel/scene/mesh_files/points.h"

namespace hogel::scene::mesh_files {

/// The vertices of a file whose faces refer to them by number.
struct Vertices : Points {
    std::vector<TextureCoordinate> coordinates;  ///< empty or as long as `positions`
};

/// What a face gives one of its corners.
struct CornerLook {
    TextureCoordinate coordinate;
    Rgb color;  ///< linear
};

/// What faces may give their vertices.
struct FaceAttributes {
    bool coordinates = false, colors = false, pictures = false;

    bool any() const { return coordinates || colors || pictures; }
};

/// Builds a mesh for each picture. Where faces give nothing to vertices, it has the vertices of the file in their
/// order; otherwise those that faces use. A vertex to which faces give several pictures, colours or texture coordinates
/// is copied for each of them.
class FaceMeshes {
  public:
    /// @param vertices  lives longer than this
    FaceMeshes(const Vertices& vertices, FaceAttributes from_faces)
        : vertices_(vertices),
          from_faces_(from_faces),
          newest_(from_faces.any() ? vertices.positions.size() : 0, none) {}

    /// The mesh of a picture, new and white when it is first asked for.
    Mesh& mesh(std::size_t picture);
    /// The index in mesh(picture) of vertex number `vertex` of the file, which exists.
    std::uint32_t corner(std::size_t vertex, std::size_t picture, const CornerLook& look);
    std::map<std::size_t, Mesh>& meshes() { return meshes_; }

  private:
    void append(std::size_t vertex, const CornerLook& look, Mesh& to) const;

    static constexpr std::uint32_t none = ~std::uint32_t{0};
    struct Copy {
        CornerLook look;
        std::size_t picture;
        std::uint32_t index;  ///< in the picture's mesh
        std::uint32_t older;  ///< another copy of the same vertex
    };
    const Vertices& vertices_;
    FaceAttributes from_faces_;
    std::map<std::size_t, Mesh> meshes_;
    std::vector<std::uint32_t> newest_;  ///< copy of each vertex of the file
    std::vector<Copy> copies_;
};

}  // namespace hogel::scene::mesh_files
