// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/apply_materials.h"

#include <utility>

namespace hogel::scene::mesh_files {
namespace {

using image::TexturePixels;

/// Returns the coordinates of a mesh on a texture; empty if the mesh lacks that set.
std::vector<TextureCoordinate> coordinates_on(const GltfTexture& texture, const std::vector<TextureCoordinate>& first,
                                              const std::vector<TextureCoordinate>& second) {
    std::vector<TextureCoordinate> coordinates = texture.set == 0 ? first : second;
    if (texture.matrix != GltfTexture().matrix)
        for (TextureCoordinate& coordinate : coordinates) coordinate = texture.at(coordinate);
    return coordinates;
}

}  // namespace

void apply_materials(const GltfMaterials& materials, ImportedMesh& part, Textures& textures) {
    if (part.material >= materials.materials.size()) return;  // assimp's default material of primitives without one
    const GltfMaterial& source = materials.materials[part.material];
    Mesh& mesh = part.mesh;
    Material& material = mesh.material = source.material;
    part.is_unlit = source.is_unlit;
    const std::vector<TextureCoordinate> first = std::move(mesh.texture_coordinates);
    mesh.texture_coordinates.clear();
    if (source.color) {
        mesh.texture_coordinates = coordinates_on(*source.color, first, part.second_coordinates);
        const bool opaque = material.alpha_mode == AlphaMode::opaque;
        if (!mesh.texture_coordinates.empty()) {
            material.base_color_texture =
                textures.get(source.color->image, opaque ? TexturePixels::color : TexturePixels::color_and_alpha);
            material.base_color_sampling = source.color->sampling;
        }
    }
    // Do not store the coordinates of the base-colour texture twice.
    const auto assign_coordinates = [&](const GltfTexture& texture, std::vector<TextureCoordinate>& coordinates) {
        if (material.base_color_texture && texture.lies_like(*source.color)) return true;
        coordinates = coordinates_on(texture, first, part.second_coordinates);
        return !coordinates.empty();
    };
    if (source.emission && assign_coordinates(*source.emission, mesh.emission_coordinates)) {
        material.emission_texture = textures.get(source.emission->image);
        material.emission_sampling = source.emission->sampling;
    } else if (material.emission != Rgb{0, 0, 0} && material.base_color_texture) {
        material.emission_texture = white_picture();  // prevents the base-colour texture from multiplying the emission
    }
    if (source.metallic_roughness &&
        assign_coordinates(*source.metallic_roughness, mesh.metallic_roughness_coordinates)) {
        material.metallic_roughness_texture = textures.get(source.metallic_roughness->image, TexturePixels::numbers);
        material.metallic_roughness_sampling = source.metallic_roughness->sampling;
    }
    if (source.normal && assign_coordinates(*source.normal, mesh.normal_coordinates)) {
        material.normal_texture = textures.get(source.normal->image, TexturePixels::numbers);
        material.normal_sampling = source.normal->sampling;
    }
    if (source.occlusion && assign_coordinates(*source.occlusion, mesh.occlusion_coordinates)) {
        material.occlusion_texture = textures.get(source.occlusion->image, TexturePixels::numbers);
        material.occlusion_sampling = source.occlusion->sampling;
    }
    if (material.alpha_mode == AlphaMode::opaque) mesh.alphas.clear();
    part.second_coordinates.clear();
}

}  // namespace hogel::scene::mesh_files
