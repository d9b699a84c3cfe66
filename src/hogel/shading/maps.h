// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "hogel/shading.h"
#include "hogel/shading/surface_texture.h"

namespace hogel::shading {

/// Textures of meshes other than the base colour, and the texture coordinates of all vertices of the scene.
class MeshTextures {
  public:
    /// Texture of a mesh: picture (null: none), sampling, and coordinates (may be empty).
    struct Source {
        std::shared_ptr<const Image> picture;
        TextureSampling sampling;
        const std::vector<TextureCoordinate>& coordinates;
    };
    using Select = Source (*)(const Mesh& mesh);
    MeshTextures() = default;
    MeshTextures(const Scene& scene, bool filtered, Select select);

    bool empty() const { return textures_.empty(); }
    bool has(std::size_t mesh) const { return !empty() && numbers_[mesh] != ShadedScene::no_texture; }
    /// Returns the texture of a mesh that has one.
    SurfaceTexture operator[](std::size_t mesh) const { return {textures_[numbers_[mesh]], coordinates_}; }

  private:
    std::vector<Texture> textures_;
    std::vector<std::uint32_t> numbers_;  // index of each mesh's texture
    std::vector<TextureCoordinate> coordinates_;
};

/// Return the emission textures, metallic-roughness textures, normal maps and occlusion maps of a scene.
MeshTextures emission_textures(const Scene& scene, bool filtered);
MeshTextures metallic_roughness_textures(const Scene& scene, bool filtered);
MeshTextures normal_textures(const Scene& scene, bool filtered);
MeshTextures occlusion_textures(const Scene& scene, bool filtered);

/// Returns the unit normal of a normal map at a point of a triangle with the interpolated normal `normal` (unit
/// length). With t along growing u and b along growing v, both perpendicular to the normal, it is x t + y b + z normal
/// for the map's values x, y, z. Returns `normal` where the triangle has no directions of growing u and v.
/// @param map    normal map of the triangle's mesh
/// @param scale  Material::normal_scale
Vec3 mapped_normal(const ShadedScene& scene, const SurfaceTexture& map, const std::array<std::uint32_t, 3>& vertices,
                   const std::array<float, 3>& weights, double footprint, Vec3 normal, float scale);

/// Returns a lighting model that adds the light of emission textures, evaluated at each sample of the light field, to
/// `lighting` (null: no other light). Returns `lighting` if no surface has an emission texture.
std::shared_ptr<const SampleLighting> with_maps(const Scene& scene, const ShadingOptions& options,
                                                std::shared_ptr<const SampleLighting> lighting);

}  // namespace hogel::shading
