// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hogel/scene.h"
#include "hogel/scene/mesh_files/gltf.h"
#include "hogel/scene/mesh_files/transfer.h"

namespace hogel::scene::mesh_files {

/// Reference of a glTF material to a texture.
struct GltfTexture {
    std::uint32_t image = 0;  ///< index in GltfMaterials::images
    TextureSampling sampling;
    unsigned set = 0;  ///< of texture coordinates: TEXCOORD_0 or TEXCOORD_1
    /// Map from the mesh's coordinates to the texture's (KHR_texture_transform), v downwards as in glTF: u' = m[0] u +
    /// m[1] v + m[2], v' = m[3] u + m[4] v + m[5].
    std::array<double, 6> matrix{1, 0, 0, 0, 1, 0};

    /// Returns the texture coordinate of a mesh coordinate; v upwards in both.
    TextureCoordinate at(TextureCoordinate mesh) const;
    /// Returns whether both use the same coordinates.
    bool lies_like(const GltfTexture& other) const { return set == other.set && matrix == other.matrix; }
};

struct GltfMaterial {
    Material material;  ///< without textures
    bool is_unlit = false;
    std::optional<GltfTexture> color, emission, metallic_roughness, normal, occlusion;
};

/// Materials, lights and cameras of a glTF file, which are read here instead of by assimp.
struct GltfMaterials {
    std::vector<GltfMaterial> materials;
    std::vector<TextureSource> images;
    std::vector<Light> lights;         ///< of the displayed scene, in its world frame
    std::vector<SceneCamera> cameras;  ///< the same
    std::vector<std::string> notes;    ///< Scene::notes
};

/// A glTF file after the checks.
struct CheckedGltf {
    /// Document for assimp: the checked parts that hogel uses and assimp reads. Empty for glTF 1, which is not checked.
    std::string contents;
    Metadata provenance;  ///< stored by write_baked_scene()
    GltfMaterials materials;
};

/// Checks a complete glTF file with its buffers in `folder` (canonical). Throws Error(bad_input).
CheckedGltf check_gltf(const std::string& file, const std::filesystem::path& folder, std::string_view bytes);

/// Convert between the index of a material and its name in CheckedGltf::contents.
std::string numbered_material(std::size_t number);
std::optional<std::size_t> material_number(std::string_view name);

/// Reads materials, lights and cameras of checked nodes and accessors. Throws Error(bad_input).
GltfMaterials read_materials(const Gltf& gltf, const GltfBuffers& buffers);

/// Reads the lights (KHR_lights_punctual) and cameras of the displayed scene's nodes.
void read_lights(const Gltf& gltf, GltfMaterials& materials);

/// Adds a note for each unsupported feature of the document.
void note_what_is_left_out(const Gltf& gltf, GltfMaterials& materials);

/// Returns a finite number of an object, or `fallback` if it is missing.
double number_or(const Gltf& gltf, const Json& object, const std::string& where, const char* name, double fallback);

/// Returns fallback.size() finite numbers of an object, or `fallback` if they are missing.
std::vector<double> numbers_or(const Gltf& gltf, const Json& object, const std::string& where, const char* name,
                               std::vector<double> fallback);

/// Returns a nested object by a path such as {"extensions", "KHR_materials_ior"}; null if it is missing.
const Json* find_object(const Gltf& gltf, const Json& object, const std::string& where,
                        std::initializer_list<const char*> path);

}  // namespace hogel::scene::mesh_files
