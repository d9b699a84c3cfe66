// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hogel/core/child_process.h"
#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

/// A texture as a mesh file names or holds it. The child process sends it undecoded, because the library that decodes
/// pictures works on several threads.
struct TextureSource {
    enum class Kind : std::uint32_t { file, encoded, texels };
    Kind kind = Kind::file;
    std::string name;                  ///< in the mesh file
    std::uint32_t width = 0;           ///< of texels
    std::uint32_t height = 0;          ///< of texels
    std::vector<unsigned char> bytes;  ///< encoded: a picture file; texels: R, G, B of 8 bits
};

/// A mesh without its texture and without added normals.
struct ImportedMesh {
    static constexpr std::uint32_t no_texture = ~std::uint32_t{0};
    Mesh mesh;
    std::uint32_t texture = no_texture;  ///< number of a TextureSource that was sent before
    /// OBJ: the pictures of opacity and of emission, the same.
    std::uint32_t opacity_texture = no_texture, emission_texture = no_texture;
    bool is_unlit = false;  ///< the material's colour is its radiance (glTF: KHR_materials_unlit)
    static constexpr std::uint32_t no_material = ~std::uint32_t{0};
    std::uint32_t material = no_material;                    ///< number in GltfMaterials::materials
    std::vector<TextureCoordinate> second_coordinates = {};  ///< TEXCOORD_1
};

struct Imported {
    std::vector<ImportedMesh> meshes;
    std::vector<TextureSource> textures;
    Metadata provenance;             ///< which the parent reads
    std::vector<std::string> notes;  ///< Scene::notes
    bool has_singles = true;         ///< coordinates are single floats
};

/// In the child: sends what was read, piece by piece, so that it is not held twice.
class Sender {
  public:
    explicit Sender(int pipe) : pipe_(pipe) {}
    /// A file that was read, before what was in it: the parent looks up its size.
    void send_file(const std::filesystem::path& path) const;
    void send(const TextureSource& texture) const;
    void send(const ImportedMesh& mesh) const;
    /// For Scene::notes.
    void send_note(const std::string& note) const;
    /// Instead of anything further: what import_scene() is to say.
    void send_error(const std::string& message) const;
    /// After the last piece.
    void send_end() const;

  private:
    int pipe_;
};

/// Receives what a Sender sends. The child may have been taken over by a hostile file: sizes are checked before memory
/// is reserved, against those of the files that were read; indices by validate() later. Throws Error(bad_input) with
/// the message that was sent, and ChildFailure.
/// @param folder  of the mesh, canonical
Imported receive(core::ChildProcess& child, const std::filesystem::path& folder, const std::string& file);

}  // namespace hogel::scene::mesh_files
