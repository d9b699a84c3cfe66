// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/layers.h"

#include <algorithm>
#include <map>
#include <memory>

namespace hogel::shading {
namespace {

/// Returns the smallest alpha of a picture. Each picture is scanned once.
class SmallestAlphas {
  public:
    float operator()(const std::shared_ptr<const Image>& picture) {
        if (!picture || picture->channels() < 4) return 1;
        const auto [known, is_new] = known_.try_emplace(picture.get(), 1.0f);
        if (is_new)
            for (std::size_t i = 3; i < picture->pixels.size(); i += 4)
                known->second = std::min(known->second, picture->pixels.data()[i]);
        return known->second;
    }

  private:
    std::map<const Image*, float> known_;
};

// Minimum alpha of an opaque surface. Below 1, because alpha is a product of rounded 8-bit numbers.
constexpr float opaque = 1 - 1.0f / 1024;

}  // namespace

void set_alphas(const Scene& scene, ShadedScene& shaded) {
    shaded.alphas.clear();
    shaded.mesh_alphas.clear();
    SmallestAlphas smallest;
    std::vector<ShadedScene::MeshAlpha> mesh_alphas(scene.meshes.size());
    bool any = false;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const Material& material = mesh.material;
        if (material.alpha_mode == AlphaMode::opaque) continue;
        float minimum = material.alpha * smallest(material.base_color_texture);
        if (!mesh.alphas.empty()) minimum *= std::ranges::min(mesh.alphas);
        if (minimum >= (material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : opaque)) continue;
        mesh_alphas[m] = {material.alpha_mode, material.alpha_cutoff};
        any = true;
    }
    if (!any) return;
    shaded.mesh_alphas = std::move(mesh_alphas);
    for (const Mesh& mesh : scene.meshes)
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            shaded.alphas.push_back(mesh.material.alpha * (mesh.alphas.empty() ? 1 : mesh.alphas[i]));
}

void separate_layers(ShadedScene& shaded) {
    if (shaded.mesh_alphas.empty()) return;
    auto layers = std::make_shared<ShadedScene>();
    layers->positions = shaded.positions;
    layers->radiance = shaded.radiance;
    layers->texture_coordinates = shaded.texture_coordinates;
    layers->textures = shaded.textures;
    layers->background = shaded.background;
    layers->fronts_only = shaded.fronts_only;
    layers->lighting = shaded.lighting;
    layers->alphas = std::move(shaded.alphas);
    layers->mesh_alphas = std::move(shaded.mesh_alphas);
    shaded.alphas.clear();
    shaded.mesh_alphas.clear();
    const auto is_layer = [&](const ShadedScene::Triangle& triangle) { return layers->is_layer(triangle.mesh); };
    std::ranges::copy_if(shaded.triangles, std::back_inserter(layers->triangles), is_layer);
    std::erase_if(shaded.triangles, is_layer);
    if (!layers->triangles.empty()) shaded.layers = std::move(layers);
}

}  // namespace hogel::shading
