// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "hogel/shading.h"

namespace hogel::shading {

/// Texture on the triangles of a scene: the picture, and the texture coordinates of the scene's vertices.
struct SurfaceTexture {
    const Texture& texture;
    const std::vector<TextureCoordinate>& coordinates;

    TextureCoordinate at(const std::array<std::uint32_t, 3>& vertices, const std::array<float, 3>& weights) const {
        const auto &a = coordinates[vertices[0]], &b = coordinates[vertices[1]], &c = coordinates[vertices[2]];
        return {weights[0] * a.u + weights[1] * b.u + weights[2] * c.u,
                weights[0] * a.v + weights[1] * b.v + weights[2] * c.v};
    }

    /// Returns the width in texels of a sample that is `footprint` metres wide on the triangle, from the ratio of the
    /// triangle's areas in the texture and in space.
    double width(const ShadedScene& scene, const std::array<std::uint32_t, 3>& vertices, double footprint) const {
        if (!texture.filtered() || !(footprint > 0)) return 0;
        const auto [a, b, c] = vertices;
        const Vec3 ab = scene.positions[b] - scene.positions[a], ac = scene.positions[c] - scene.positions[a];
        const TextureCoordinate &ta = coordinates[a], &tb = coordinates[b], &tc = coordinates[c];
        const double u1 = double{tb.u} - ta.u, v1 = double{tb.v} - ta.v, u2 = double{tc.u} - ta.u,
                     v2 = double{tc.v} - ta.v;
        const double in_texels = std::abs(u1 * v2 - u2 * v1) * texture.texels();
        const double in_metres = length(cross(ab, ac));
        return in_metres > 0 ? footprint * std::sqrt(in_texels / in_metres) : 0;
    }

    Rgb sample(const ShadedScene& scene, const std::array<std::uint32_t, 3>& vertices,
               const std::array<float, 3>& weights, double footprint) const {
        return texture.sample(at(vertices, weights), width(scene, vertices, footprint));
    }
};

}  // namespace hogel::shading
