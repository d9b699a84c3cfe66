// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "hogel/scene.h"

namespace hogel::scene {

/// Builder of a mesh of coloured vertices without normals; add_missing_normals() adds them, joining equal positions.
class MeshBuilder {
  public:
    using Index = std::uint32_t;

    Index vertex(Vec3 position, Rgb color) {
        mesh.positions.push_back(position);
        mesh.colors.push_back(color);
        return static_cast<Index>(mesh.positions.size() - 1);
    }
    void triangle(Index a, Index b, Index c) { mesh.triangles.push_back({a, b, c}); }
    void quad(Index a, Index b, Index c, Index d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }

    /// Adds a patch of columns × rows quads with vertices at(i, k), 0 <= i <= columns, 0 <= k <= rows. Seen from its
    /// front, i runs to the right and k up. If `wraps`, column `columns` is column 0.
    void patch(std::size_t columns, std::size_t rows, bool wraps,
               const std::function<Vec3(std::size_t, std::size_t)>& at, const std::function<Rgb(Vec3)>& color) {
        const std::size_t across = wraps ? columns : columns + 1;
        const auto base = static_cast<Index>(mesh.positions.size());
        for (std::size_t k = 0; k <= rows; ++k)
            for (std::size_t i = 0; i < across; ++i) {
                const Vec3 p = at(i, k);
                vertex(p, color(p));
            }
        const auto index = [&](std::size_t i, std::size_t k) {
            return base + static_cast<Index>(k * across + i % across);
        };
        for (std::size_t k = 0; k < rows; ++k)
            for (std::size_t i = 0; i < columns; ++i)
                quad(index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k + 1));
    }

    /// Adds a surface about the vertical through `foot`: profile(k) is (radius, height), upwards for an outer surface.
    void revolve(Vec3 foot, std::size_t columns, std::size_t rows,
                 const std::function<std::pair<double, double>(std::size_t)>& profile,
                 const std::function<Rgb(Vec3)>& color) {
        patch(
            columns, rows, true,
            [&](std::size_t i, std::size_t k) {
                const auto [radius, height] = profile(k);
                const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(columns);
                return foot + Vec3{radius * std::sin(angle), height, radius * std::cos(angle)};
            },
            color);
    }

    Mesh mesh;
};

/// Returns a pseudorandom number in 0..1 that depends only on the three integers.
inline double hashed(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::uint32_t h = a * 0x9E3779B1u ^ b * 0x85EBCA77u ^ c * 0xC2B2AE3Du;
    h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
    h = (h ^ (h >> 12)) * 0x297A2D39u;
    return static_cast<double>(h ^ (h >> 15)) / 4294967296.0;
}

inline double square(double x) { return x * x; }

inline Rgb mix(Rgb a, Rgb b, double weight) {
    const auto w = static_cast<float>(weight < 0 ? 0 : weight > 1 ? 1 : weight);
    return (1 - w) * a + w * b;
}

/// Rotates scene and lights, in radians, about the vertical, then about x (positive: top towards the viewer).
inline void rotate(Scene& scene, double about_y, double about_x) {
    const double cy = std::cos(about_y), sy = std::sin(about_y), cx = std::cos(about_x), sx = std::sin(about_x);
    const auto rotated = [&](Vec3 p) {
        const Vec3 q{cy * p.x + sy * p.z, p.y, cy * p.z - sy * p.x};
        return Vec3{q.x, cx * q.y - sx * q.z, cx * q.z + sx * q.y};
    };
    for (Mesh& mesh : scene.meshes) {
        for (Vec3& p : mesh.positions) p = rotated(p);
        for (Vec3& n : mesh.normals) n = rotated(n);
    }
    for (Light& light : scene.lights) {
        light.position = rotated(light.position);
        light.direction = rotated(light.direction);
    }
}

}  // namespace hogel::scene
