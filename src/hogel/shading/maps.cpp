// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/maps.h"

#include <algorithm>
#include <map>
#include <utility>

#include "hogel/shading/lighting.h"

namespace hogel::shading {
namespace {

MeshTextures::Source emission_of(const Mesh& mesh) {
    return {mesh.material.emission_texture, mesh.material.emission_sampling,
            mesh.emission_coordinates.empty() ? mesh.texture_coordinates : mesh.emission_coordinates};
}

MeshTextures::Source metallic_roughness_of(const Mesh& mesh) {
    return {
        mesh.material.metallic_roughness_texture, mesh.material.metallic_roughness_sampling,
        mesh.metallic_roughness_coordinates.empty() ? mesh.texture_coordinates : mesh.metallic_roughness_coordinates};
}

/// Adds emission to what surfaces show by another lighting or, where that has none, by their vertices.
class EmissionLighting final : public SampleLighting {
  public:
    EmissionLighting(const Scene& scene, MeshTextures textures, std::shared_ptr<const SampleLighting> lighting)
        : textures_(std::move(textures)), lighting_(std::move(lighting)) {
        for (const Mesh& mesh : scene.meshes) {
            factors_.push_back(mesh.material.emission);
            given_.push_back(!mesh.radiance.empty());
        }
    }

    Size size_of_light(std::size_t mesh) const override {
        const Size size = lighting_ ? lighting_->size_of_light(mesh) : Size{};
        return size.sum() == 0 && emits(mesh) ? Size{3, 0} : size;
    }
    bool light_is_radiance(std::size_t mesh) const override {
        return !emits(mesh) && lighting_ && lighting_->light_is_radiance(mesh);
    }
    void light_on(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                  std::span<float> light) const override {
        const ShadedScene::Triangle& triangle = scene.triangles[index];
        if (is_lit(triangle.mesh)) return lighting_->light_on(scene, index, weights, light);
        const Rgb radiance = interpolate(scene.radiance, triangle.vertices, weights);
        light[0] = radiance.r, light[1] = radiance.g, light[2] = radiance.b;
    }
    Rgb radiance(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                 std::span<const float> light, Rgb texture, const ViewSample& view) const override {
        const ShadedScene::Triangle& triangle = scene.triangles[index];
        const Rgb seen = is_lit(triangle.mesh) ? lighting_->radiance(scene, index, weights, light, texture, view)
                                               : texture * Rgb{light[0], light[1], light[2]};
        if (!emits(triangle.mesh)) return seen;
        return seen + factors_[triangle.mesh] *
                          textures_[triangle.mesh].sample(scene, triangle.vertices, weights, view.footprint);
    }

  private:
    bool emits(std::size_t mesh) const { return textures_.has(mesh) && !given_[mesh]; }
    bool is_lit(std::size_t mesh) const { return lighting_ && lighting_->size_of_light(mesh).sum() > 0; }

    MeshTextures textures_;
    std::shared_ptr<const SampleLighting> lighting_;
    std::vector<Rgb> factors_;  // one per mesh
    std::vector<bool> given_;
};

}  // namespace

MeshTextures::MeshTextures(const Scene& scene, bool filtered, Of of) {
    if (std::ranges::none_of(scene.meshes, [&](const Mesh& mesh) { return of(mesh).picture != nullptr; })) return;
    std::map<const Image*, std::vector<std::uint32_t>> known;
    for (const Mesh& mesh : scene.meshes) {
        const auto [picture, sampling, coordinates] = of(mesh);
        std::uint32_t number = ShadedScene::no_texture;
        if (picture && picture->pixels.size() > 0) {
            auto& same = known[picture.get()];
            for (const std::uint32_t other : same)
                if (textures_[other].sampling() == sampling) number = other;
            if (number == ShadedScene::no_texture) {
                number = static_cast<std::uint32_t>(textures_.size());
                same.push_back(number);
                textures_.emplace_back(picture, filtered, sampling);
            }
        }
        numbers_.push_back(number);
        const std::size_t end = coordinates_.size() + mesh.positions.size();
        coordinates_.insert(coordinates_.end(), coordinates.begin(), coordinates.end());
        coordinates_.resize(end);
    }
}

MeshTextures emission_textures(const Scene& scene, bool filtered) { return {scene, filtered, emission_of}; }
MeshTextures metallic_roughness_textures(const Scene& scene, bool filtered) {
    return {scene, filtered, metallic_roughness_of};
}

std::shared_ptr<const SampleLighting> with_maps(const Scene& scene, const ShadingOptions& options,
                                                std::shared_ptr<const SampleLighting> lighting) {
    MeshTextures emission = emission_textures(scene, options.filter_textures);
    if (emission.empty()) return lighting;
    return std::make_shared<EmissionLighting>(scene, std::move(emission), std::move(lighting));
}

}  // namespace hogel::shading
