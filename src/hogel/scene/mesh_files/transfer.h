// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hogel/core/child_process.h"
#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

/// A texture, named or embedded. The child sends it encoded: the picture decoder is multithreaded.
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
    std::uint32_t texture = no_texture;  ///< index of a TextureSource sent before
    /// OBJ: opacity and emission pictures, likewise.
    std::uint32_t opacity_texture = no_texture, emission_texture = no_texture;
    bool is_unlit = false;  ///< the material's colour is its radiance (glTF: KHR_materials_unlit)
    static constexpr std::uint32_t no_material = ~std::uint32_t{0};
    std::uint32_t material = no_material;                    ///< index in GltfMaterials::materials
    std::vector<TextureCoordinate> second_coordinates = {};  ///< TEXCOORD_1
};

struct Imported {
    std::vector<ImportedMesh> meshes;
    std::vector<TextureSource> textures;
    Metadata provenance;             ///< read by the parent
    std::vector<std::string> notes;  ///< Scene::notes
    bool has_singles = true;         ///< coordinates are single floats
};

/// Child side: sends the contents piecewise, to avoid a second copy in memory.
class Sender {
  public:
    explicit Sender(int pipe) : pipe_(pipe) {}
    /// Sends an opened file before its contents; the parent looks up its size.
    void send_file(const std::filesystem::path& path) const;
    void send(const TextureSource& texture) const;
    void send(const ImportedMesh& mesh) const;
    /// Sends a line of Scene::notes.
    void send_note(const std::string& note) const;
    /// Sends the error of import_scene(), in place of any further data.
    void send_error(const std::string& message) const;
    /// Ends the transfer.
    void send_end() const;

  private:
    int pipe_;
};

/// Receives the data of a Sender, which may be compromised by a hostile file. Checks sizes against those of the opened
/// files before allocation; validate() checks indices later. Throws Error(bad_input) from the child, and ChildFailure.
/// @param folder  of the mesh, canonical
Imported receive(core::ChildProcess& child, const std::filesystem::path& folder, const std::string& file);

}  // namespace hogel::scene::mesh_files
