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

/// A texture as a material of a glTF file refers to it.
struct GltfTexture {
    std::uint32_t image = 0;  ///< number of GltfMaterials::images
    TextureSampling sampling;
    unsigned set = 0;  ///< of texture coordinates: TEXCOORD_0 or TEXCOORD_1
    /// From the mesh's coordinates to those of the texture (KHR_texture_transform), v downwards as in glTF: u' = m[0] u
    /// + m[1] v + m[2], v' = m[3] u + m[4] v + m[5].
    std::array<double, 6> matrix{1, 0, 0, 0, 1, 0};

    /// Where a point of the mesh is on the texture; v upwards on both sides.
    TextureCoordinate at(TextureCoordinate mesh) const;
    /// Whether both have the same coordinates.
    bool lies_like(const GltfTexture& other) const { return set == other.set && matrix == other.matrix; }
};

struct GltfMaterial {
    Material material;  ///< without textures
    bool is_unlit = false;
    std::optional<GltfTexture> color, emission, metallic_roughness, normal, occlusion;
};

/// What a glTF file says of looks, which is read here and not by assimp.
struct GltfMaterials {
    std::vector<GltfMaterial> materials;
    std::vector<TextureSource> images;
    std::vector<Light> lights;         ///< of the scene that is shown, in its world frame
    std::vector<SceneCamera> cameras;  ///< the same
    std::vector<std::string> notes;    ///< Scene::notes
};

/// A glTF file that was checked before assimp reads it.
struct CheckedGltf {
    /// What assimp is to read instead: what was checked, without what hogel does not use or reads itself. Empty for a
    /// document of glTF 1, which is not checked.
    std::string contents;
    Metadata provenance;  ///< what write_baked_scene() stored there, if anything
    GltfMaterials looks;
};

/// Checks a glTF file, whose buffers lie in `folder` (canonical). `bytes` is the whole file. Throws Error(bad_input).
CheckedGltf check_gltf(const std::string& file, const std::filesystem::path& folder, std::string_view bytes);

/// The name that a material has in CheckedGltf::contents, and its number again.
std::string numbered_material(std::size_t number);
std::optional<std::size_t> material_number(std::string_view name);

/// Throws Error(bad_input), naming the place, for what is not as glTF has it. Nodes and accessors must have been
/// checked.
GltfMaterials read_materials(const Gltf& gltf, const GltfBuffers& buffers);

/// The lights of KHR_lights_punctual and the cameras that the nodes of the scene hold.
void read_lights(const Gltf& gltf, GltfMaterials& looks);

/// Adds to the notes what of the document is not shown.
void note_what_is_left_out(const Gltf& gltf, GltfMaterials& looks);

/// A finite number of an object; `otherwise` where it is missing.
double number_or(const Gltf& gltf, const Json& object, const std::string& where, const char* name, double otherwise);

/// `size` finite numbers; `otherwise` where they are missing.
std::vector<double> numbers_or(const Gltf& gltf, const Json& object, const std::string& where, const char* name,
                               std::vector<double> otherwise);

/// An object inside of another one, by a path such as {"extensions", "KHR_materials_ior"}; null where it is missing.
const Json* find_object(const Gltf& gltf, const Json& object, const std::string& where,
                        std::initializer_list<const char*> path);

}  // namespace hogel::scene::mesh_files
