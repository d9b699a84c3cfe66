// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/radiance_at.h"
#include "hogel/core/thread_buffer.h"

#include <algorithm>
#include <array>

#include "hogel/shading/radiance_cache.h"
#include "hogel/shading/surface_texture.h"

namespace hogel {

using namespace shading;

namespace {

SurfaceTexture texture_of(const ShadedScene& scene, const ShadedScene::Triangle& triangle) {
    return {scene.textures[triangle.texture], scene.texture_coordinates};
}

// Returns the radiance of a point with light evaluated per sample, read from the cache or computed now.
Rgb lit_radiance(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights, Rgb texture,
                 const ViewSample& view) {
    const std::size_t size = scene.lighting->size_of_light(scene.triangles[index].mesh).sum();
    const core::ThreadBuffer<float> buffer(size);
    const std::span<float> light(buffer.data(), size);
    if (!scene.radiance_cache || !scene.radiance_cache->read(scene, index, weights, light))
        scene.lighting->light_on(scene, index, weights, light);
    return scene.lighting->radiance(scene, index, weights, light, texture, view);
}

}  // namespace

Rgb shading::texture_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2,
                        const ViewSample& view) {
    const ShadedScene::Triangle& triangle = scene.triangles[index];
    return texture_of(scene, triangle).sample(scene, triangle.vertices, {b0, b1, b2}, view.footprint);
}

Rgb shading::untextured_radiance_at(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                                    const ViewSample& view) {
    if (scene.is_lit(index)) return lit_radiance(scene, index, weights, {1, 1, 1}, view);
    const auto [a, b, c] = scene.triangles[index].vertices;
    return weights[0] * scene.radiance[a] + weights[1] * scene.radiance[b] + weights[2] * scene.radiance[c];
}

Rgb radiance_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2, const ViewSample& view) {
    const ShadedScene::Triangle& triangle = scene.triangles[index];
    const bool textured = triangle.texture != ShadedScene::no_texture;
    const Rgb texture = textured ? texture_at(scene, index, b0, b1, b2, view) : Rgb{1, 1, 1};
    if (scene.is_lit(index)) return lit_radiance(scene, index, {b0, b1, b2}, texture, view);
    const auto [a, b, c] = triangle.vertices;
    const Rgb radiance = b0 * scene.radiance[a] + b1 * scene.radiance[b] + b2 * scene.radiance[c];
    return textured ? radiance * texture : radiance;
}

float opacity_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2, const ViewSample& view) {
    const ShadedScene::Triangle& triangle = scene.triangles[index];
    if (!scene.is_layer(triangle.mesh)) return 1;
    const ShadedScene::MeshAlpha& meaning = scene.mesh_alphas[triangle.mesh];
    const auto [a, b, c] = triangle.vertices;
    float alpha = b0 * scene.alphas[a] + b1 * scene.alphas[b] + b2 * scene.alphas[c];
    if (triangle.texture != ShadedScene::no_texture) {
        const SurfaceTexture texture = texture_of(scene, triangle);
        const bool mask = meaning.mode == AlphaMode::mask;
        alpha *= texture.texture.alpha(texture.at(triangle.vertices, {b0, b1, b2}),
                                       mask ? 0 : texture.width(scene, triangle.vertices, view.footprint));
    }
    if (meaning.mode == AlphaMode::mask) return alpha >= meaning.cutoff ? 1.0f : 0.0f;
    return std::clamp(alpha, 0.0f, 1.0f);
}

}  // namespace hogel
