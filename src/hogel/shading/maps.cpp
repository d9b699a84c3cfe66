// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/maps.h"

#include <algorithm>
#include <cmath>
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

MeshTextures::Source normal_of(const Mesh& mesh) {
    return {mesh.material.normal_texture, mesh.material.normal_sampling,
            mesh.normal_coordinates.empty() ? mesh.texture_coordinates : mesh.normal_coordinates};
}

MeshTextures::Source occlusion_of(const Mesh& mesh) {
    return {mesh.material.occlusion_texture, mesh.material.occlusion_sampling,
            mesh.occlusion_coordinates.empty() ? mesh.texture_coordinates : mesh.occlusion_coordinates};
}

/// Adds emission to the radiance of another lighting or, where there is none, of the vertices.
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
        const Rgb radiance = is_lit(triangle.mesh) ? lighting_->radiance(scene, index, weights, light, texture, view)
                                                   : texture * Rgb{light[0], light[1], light[2]};
        if (!emits(triangle.mesh)) return radiance;
        return radiance + factors_[triangle.mesh] *
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

MeshTextures::MeshTextures(const Scene& scene, bool filtered, Select select) {
    if (std::ranges::none_of(scene.meshes, [&](const Mesh& mesh) { return select(mesh).picture != nullptr; })) return;
    std::map<const Image*, std::vector<std::uint32_t>> by_picture;
    for (const Mesh& mesh : scene.meshes) {
        const auto [picture, sampling, coordinates] = select(mesh);
        std::uint32_t number = ShadedScene::no_texture;
        if (picture && picture->pixels.size() > 0) {
            auto& indices = by_picture[picture.get()];
            for (const std::uint32_t other : indices)
                if (textures_[other].sampling() == sampling) number = other;
            if (number == ShadedScene::no_texture) {
                number = static_cast<std::uint32_t>(textures_.size());
                indices.push_back(number);
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
MeshTextures normal_textures(const Scene& scene, bool filtered) { return {scene, filtered, normal_of}; }
MeshTextures occlusion_textures(const Scene& scene, bool filtered) { return {scene, filtered, occlusion_of}; }

Vec3 mapped_normal(const ShadedScene& scene, const SurfaceTexture& map, const std::array<std::uint32_t, 3>& vertices,
                   const std::array<float, 3>& weights, double footprint, Vec3 normal, float scale) {
    const auto [a, b, c] = vertices;
    const Vec3 ab = scene.positions[b] - scene.positions[a], ac = scene.positions[c] - scene.positions[a];
    const TextureCoordinate &ta = map.coordinates[a], &tb = map.coordinates[b], &tc = map.coordinates[c];
    const double u1 = double{tb.u} - ta.u, v1 = double{tb.v} - ta.v, u2 = double{tc.u} - ta.u, v2 = double{tc.v} - ta.v;
    // On the triangle p = a + s ab + t ac, and (u, v) is linear in s and t. So dp/du is (v2 ab − v1 ac) over the
    // determinant. The sign of the determinant is the side on which v grows.
    const double area = u1 * v2 - u2 * v1;
    if (area == 0) return normal;
    const Vec3 gradient = std::copysign(1.0, area) * (v2 * ab - v1 * ac);
    const Vec3 tangent = gradient - dot(gradient, normal) * normal;
    const double size = length(tangent);
    if (!(size > 0)) return normal;
    const Vec3 t = tangent / size;
    // Seen from the front, v grows to the left of growing u, unless the texture is mirrored.
    const double side = std::copysign(1.0, area) * (dot(cross(ab, ac), normal) < 0 ? -1 : 1);
    const Vec3 bitangent = side * cross(normal, t);
    const Rgb value = map.sample(scene, vertices, weights, footprint);
    const double x = scale * (2 * double{value.r} - 1), y = scale * (2 * double{value.g} - 1),
                 z = 2 * double{value.b} - 1;
    const Vec3 mapped = x * t + y * bitangent + z * normal;
    const double mapped_size = length(mapped);
    return mapped_size > 0 ? mapped / mapped_size : normal;
}

std::shared_ptr<const SampleLighting> with_maps(const Scene& scene, const ShadingOptions& options,
                                                std::shared_ptr<const SampleLighting> lighting) {
    MeshTextures emission = emission_textures(scene, options.filter_textures);
    if (emission.empty()) return lighting;
    return std::make_shared<EmissionLighting>(scene, std::move(emission), std::move(lighting));
}

}  // namespace hogel::shading
