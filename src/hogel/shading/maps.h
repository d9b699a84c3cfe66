// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "hogel/shading.h"
#include "hogel/shading/surface_texture.h"

namespace hogel::shading {

/// A texture of some meshes that is not their base colour: one for each mesh, and where all vertices of the scene are
/// on the textures of their meshes.
class MeshTextures {
  public:
    /// @param of  the texture of a mesh: its picture, its sampling and its coordinates, which may be empty; a null
    ///            picture: none
    struct Source {
        std::shared_ptr<const Image> picture;
        TextureSampling sampling;
        const std::vector<TextureCoordinate>& coordinates;
    };
    using Of = Source (*)(const Mesh& mesh);
    MeshTextures() = default;
    MeshTextures(const Scene& scene, bool filtered, Of of);

    bool empty() const { return textures_.empty(); }
    bool has(std::size_t mesh) const { return !empty() && numbers_[mesh] != ShadedScene::no_texture; }
    /// The texture of a mesh that has one.
    SurfaceTexture operator[](std::size_t mesh) const { return {textures_[numbers_[mesh]], coordinates_}; }

  private:
    std::vector<Texture> textures_;
    std::vector<std::uint32_t> numbers_;  // of each mesh
    std::vector<TextureCoordinate> coordinates_;
};

/// Emission textures, metallic-roughness textures, normal maps and occlusion maps.
MeshTextures emission_textures(const Scene& scene, bool filtered);
MeshTextures metallic_roughness_textures(const Scene& scene, bool filtered);
MeshTextures normal_textures(const Scene& scene, bool filtered);
MeshTextures occlusion_textures(const Scene& scene, bool filtered);

/// The unit normal that a normal map gives at a point of a triangle whose interpolated normal is `normal` (unit
/// length): with t along growing u and b along growing v, both across the normal, it is x t + y b + z normal for the
/// numbers x, y, z of the map. The normal itself where the triangle has no directions of growing u and v.
/// @param map    of the triangle's mesh
/// @param scale  Material::normal_scale
Vec3 mapped_normal(const ShadedScene& scene, const SurfaceTexture& map, const std::array<std::uint32_t, 3>& vertices,
                   const std::array<float, 3>& weights, double footprint, Vec3 normal, float scale);

/// Adds the light that surfaces with an emission texture emit, at each sample, to the lighting of a model, which may be
/// null; returns that lighting if there are none.
std::shared_ptr<const SampleLighting> with_maps(const Scene& scene, const ShadingOptions& options,
                                                std::shared_ptr<const SampleLighting> lighting);

}  // namespace hogel::shading
