// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hogel/scene.h"
#include "hogel/scene/mesh_files/files.h"

namespace hogel::scene::mesh_files {

/// Converts assimp's materials. A texture shared by several materials is read once.
class MaterialImport {
  public:
    /// @param folder  of the mesh, canonical
    /// @param file    name of the mesh for messages, as the caller gave it
    MaterialImport(const aiScene& source, const std::filesystem::path& folder, std::string file);
    const Material& operator[](unsigned index);
    /// Whether the material's colour is its radiance, independent of lights (glTF: KHR_materials_unlit).
    bool is_unlit(unsigned index) const;

  private:
    Material read(const aiMaterial& source);
    std::shared_ptr<const Image> texture(const std::string& name);
    std::shared_ptr<const Image> load(const std::string& name) const;

    const aiScene& source_;
    FolderFiles files_;
    std::filesystem::path folder_;
    std::string file_;
    std::map<unsigned, Material> materials_;
    std::map<std::string, std::shared_ptr<const Image>> textures_;
};

}  // namespace hogel::scene::mesh_files
