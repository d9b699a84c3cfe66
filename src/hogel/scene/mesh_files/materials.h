// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hogel/image/texture_picture.h"
#include "hogel/scene.h"
#include "hogel/scene/mesh_files/transfer.h"

namespace hogel::scene::mesh_files {

/// Converts assimp's material, without its texture.
Material read_material(const aiMaterial& source);

/// Returns whether the material's colour is its radiance, independent of lights (glTF: KHR_materials_unlit).
bool is_unlit(const aiMaterial& source);

/// Returns the name of a material's base-colour texture; empty if there is none.
std::string base_color_texture(const aiMaterial& source);

/// Returns the texture of that name, which may be embedded in the mesh file. Throws Error(bad_input) for an empty one.
/// @param file  name of the mesh for messages, as given by the caller
TextureSource find_texture(const aiScene& source, const std::string& name, const std::string& file);

std::shared_ptr<const Image> white_picture();

/// Textures, decoded on first use.
class Textures {
  public:
    /// @param folder  of the mesh, canonical
    /// @param file    name of the mesh for messages, as given by the caller
    Textures(std::vector<TextureSource> sources, std::filesystem::path folder, std::string file);
    /// Ignores missing pictures from now on.
    void leave_out_missing() { leaves_out_ = true; }
    /// Names of the ignored pictures.
    const std::set<std::string>& missing() const { return missing_; }
    /// Returns null for ignored pictures and invalid indices. Throws Error(bad_input) for missing or damaged ones.
    std::shared_ptr<const Image> get(std::uint32_t number, image::TexturePixels pixels = image::TexturePixels::color);

    /// Returns a picture with the opacity of another as its fourth channel: the other's alpha, or its brightness
    /// without alpha. The colour is white if `color` does not exist. Returns null if `opacity` does not exist.
    std::shared_ptr<const Image> with_opacity(std::uint32_t color, std::uint32_t opacity);

  private:
    Image load(const TextureSource& source, image::TexturePixels pixels) const;
    std::optional<std::filesystem::path> find(const TextureSource& source) const;
    bool is_left_out(const TextureSource& source);

    std::vector<TextureSource> sources_;
    std::map<std::pair<std::uint32_t, image::TexturePixels>, std::shared_ptr<const Image>> images_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::shared_ptr<const Image>> with_opacity_;
    std::filesystem::path folder_;
    std::string file_;
    bool leaves_out_ = false;
    std::set<std::string> missing_;
};

/// Applies the opacity and emission pictures to a mesh of an OBJ file. `part` has its base-colour texture.
void apply_obj_materials(ImportedMesh& part, Textures& textures);

}  // namespace hogel::scene::mesh_files
