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

/// assimp's material, without its texture.
Material read_material(const aiMaterial& source);

/// Whether the material's colour is its radiance, independent of lights (glTF: KHR_materials_unlit).
bool is_unlit(const aiMaterial& source);

/// What the file calls the base-colour texture of a material; empty: there is none.
std::string base_color_texture(const aiMaterial& source);

/// The texture of that name, which may lie in the mesh file itself. Throws Error(bad_input) for an empty one.
/// @param file  name of the mesh for messages, as the caller gave it
TextureSource find_texture(const aiScene& source, const std::string& name, const std::string& file);

/// One white texel.
std::shared_ptr<const Image> white_picture();

/// Decodes textures, each when it is first asked for.
class Textures {
  public:
    /// @param folder  of the mesh, canonical
    /// @param file    name of the mesh for messages, as the caller gave it
    Textures(std::vector<TextureSource> sources, std::filesystem::path folder, std::string file);
    /// From now on missing pictures are left out.
    void leave_out_missing() { leaves_out_ = true; }
    /// The names of those that were.
    const std::set<std::string>& missing() const { return missing_; }
    /// Null for a number that does not exist, and for a picture that is left out. Throws Error(bad_input) for a missing
    /// or damaged one.
    std::shared_ptr<const Image> get(std::uint32_t number, image::TexturePixels pixels = image::TexturePixels::color);

    /// A picture with the opacity of another as its fourth channel: that one's alpha, or its brightness where it has
    /// none. White where there is no picture of that number; null where there is none of the opacity.
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

/// Gives a mesh of an OBJ file its opacity and its emission by pictures. `part` has its base-colour texture.
void apply_obj_materials(ImportedMesh& part, Textures& textures);

}  // namespace hogel::scene::mesh_files
