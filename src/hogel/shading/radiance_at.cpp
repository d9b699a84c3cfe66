// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading.h"

#include <cmath>

#include "hogel/shading/radiance_cache.h"

namespace hogel {

using namespace shading;

namespace {

/// Texels per metre on the triangle, from the ratio of its areas in the texture and in space.
double texels_per_metre(const ShadedScene& scene, const ShadedScene::Triangle& triangle) {
    const auto [a, b, c] = triangle.vertices;
    const Vec3 ab = scene.positions[b] - scene.positions[a], ac = scene.positions[c] - scene.positions[a];
    const TextureCoordinate &ta = scene.texture_coordinates[a], &tb = scene.texture_coordinates[b],
                            &tc = scene.texture_coordinates[c];
    const double u1 = double{tb.u} - ta.u, v1 = double{tb.v} - ta.v, u2 = double{tc.u} - ta.u, v2 = double{tc.v} - ta.v;
    const double in_texels = std::abs(u1 * v2 - u2 * v1) * scene.textures[triangle.texture].texels();
    const double in_metres = length(cross(ab, ac));
    return in_metres > 0 ? std::sqrt(in_texels / in_metres) : 0;
}

Rgb texture_at(const ShadedScene& scene, const ShadedScene::Triangle& triangle, float b0, float b1, float b2,
               const ViewSample& view) {
    const auto [a, b, c] = triangle.vertices;
    const Texture& texture = scene.textures[triangle.texture];
    const auto &ta = scene.texture_coordinates[a], &tb = scene.texture_coordinates[b],
               &tc = scene.texture_coordinates[c];
    const double width =
        texture.filtered() && view.footprint > 0 ? view.footprint * texels_per_metre(scene, triangle) : 0;
    return texture.sample({b0 * ta.u + b1 * tb.u + b2 * tc.u, b0 * ta.v + b1 * tb.v + b2 * tc.v}, width);
}

// The radiance of a point whose light is evaluated for samples, either read from the cache or evaluated here.
Rgb lit_radiance(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights, Rgb texture,
                 const ViewSample& view) {
    const std::size_t size = scene.lighting->size_of_light(scene.triangles[index].mesh).sum();
    thread_local std::vector<float> scratch;
    if (scratch.size() < size) scratch.resize(size);
    const std::span<float> light(scratch.data(), size);
    if (!scene.radiance_cache || !scene.radiance_cache->read(scene, index, weights, light))
        scene.lighting->light_on(scene, index, weights, light);
    return scene.lighting->radiance(scene, index, weights, light, texture, view);
}

}  // namespace

Rgb radiance_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2, const ViewSample& view) {
    const ShadedScene::Triangle& triangle = scene.triangles[index];
    const bool textured = triangle.texture != ShadedScene::no_texture;
    const Rgb texture = textured ? texture_at(scene, triangle, b0, b1, b2, view) : Rgb{1, 1, 1};
    if (scene.is_lit(index)) return lit_radiance(scene, index, {b0, b1, b2}, texture, view);
    const auto [a, b, c] = triangle.vertices;
    const Rgb radiance = b0 * scene.radiance[a] + b1 * scene.radiance[b] + b2 * scene.radiance[c];
    return textured ? radiance * texture : radiance;
}

}  // namespace hogel
