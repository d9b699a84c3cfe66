// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace hogel::scene {
namespace {

using std::numbers::pi;

double angle_of(std::size_t i, std::size_t columns) {
    return 2 * pi * static_cast<double>(i % columns) / static_cast<double>(columns);
}

}  // namespace

Across across(Vec3 along) {
    const Vec3 helper = std::abs(along.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};  // far from parallel
    const Vec3 first = normalize(cross(helper, along));
    return {first, cross(along, first)};
}

void add_ball(MeshBuilder& builder, Vec3 center, double radius, Vec3 axis, std::size_t columns,
              std::span<const Ring> rings) {
    const auto [first, second] = across(axis);
    std::size_t row = 0, vertices = 0;
    builder.patch(
        columns, rings.size() - 1, true,
        [&](std::size_t i, std::size_t k) {
            const bool pole = k == 0 || k + 1 == rings.size();
            const double angle = angle_of(i, columns), out = pole ? 0 : std::cos(rings[k].latitude);
            return center + radius * (out * std::cos(angle) * first + out * std::sin(angle) * second +
                                      std::sin(rings[k].latitude) * axis);
        },
        [&](Vec3) {
            row = vertices++ / columns;
            return rings[row].color;
        });
}

void add_ball(MeshBuilder& builder, Vec3 center, double radius, std::size_t columns, std::size_t rows, Rgb color) {
    std::vector<Ring> rings;
    for (std::size_t k = 0; k <= rows; ++k)
        rings.push_back({pi * (static_cast<double>(k) / static_cast<double>(rows) - 0.5), color});
    add_ball(builder, center, radius, {0, 1, 0}, columns, rings);
}

void add_tube(MeshBuilder& builder, std::size_t columns, std::size_t steps,
              const std::function<Vec3(std::size_t)>& point, const std::function<double(std::size_t)>& radius,
              const std::function<Rgb(Vec3)>& color) {
    // Transport the frame along the path without twist.
    std::vector<Across> frames;
    for (std::size_t k = 0; k <= steps; ++k) {
        const Vec3 along = normalize(point(std::min(k + 1, steps)) - point(k > 0 ? k - 1 : 0));
        if (k == 0) {
            frames.push_back(across(along));
            continue;
        }
        const Vec3 before = frames.back().first;
        const Vec3 first = normalize(before - dot(before, along) * along);
        frames.push_back({first, cross(along, first)});
    }
    builder.patch(
        columns, steps + 2, true,
        [&](std::size_t i, std::size_t row) {
            const std::size_t k = std::clamp<std::size_t>(row, 1, steps + 1) - 1;
            if (row == 0 || row == steps + 2) return point(k);
            const double angle = angle_of(i, columns);
            return point(k) + radius(k) * (std::cos(angle) * frames[k].first + std::sin(angle) * frames[k].second);
        },
        color);
}

void add_rod(MeshBuilder& builder, Vec3 from, Vec3 to, double radius, std::size_t columns, Rgb color) {
    add_tube(
        builder, columns, 1, [&](std::size_t k) { return k == 0 ? from : to; }, [&](std::size_t) { return radius; },
        [&](Vec3) { return color; });
}

void add_torus(MeshBuilder& builder, Vec3 center, Vec3 axis, double radius, double thickness, std::size_t around,
               std::size_t columns, Rgb color) {
    const auto [first, second] = across(axis);
    const auto point = [&](std::size_t i, std::size_t k) {
        const double angle = angle_of(k, around), turn = angle_of(i, columns);
        const Vec3 out = std::cos(angle) * first + std::sin(angle) * second;
        return center + (radius + thickness * std::cos(turn)) * out - thickness * std::sin(turn) * axis;
    };
    const auto base = static_cast<MeshBuilder::Index>(builder.mesh.positions.size());
    for (std::size_t k = 0; k < around; ++k)
        for (std::size_t i = 0; i < columns; ++i) builder.vertex(point(i, k), color);
    const auto index = [&](std::size_t i, std::size_t k) {
        return base + static_cast<MeshBuilder::Index>(k % around * columns + i % columns);
    };
    for (std::size_t k = 0; k < around; ++k)
        for (std::size_t i = 0; i < columns; ++i)
            builder.quad(index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k + 1));
}

void add_box(MeshBuilder& builder, Vec3 low, Vec3 high, double patch, const std::function<Rgb(Vec3)>& color) {
    const std::array<double, 3> from{low.x, low.y, low.z}, size{high.x - low.x, high.y - low.y, high.z - low.z};
    std::array<std::size_t, 3> parts{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        parts[axis] = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(size[axis] / patch - 1e-9)));
    // One face per axis and end. Faces have bit-identical points on shared edges.
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool far : {false, true}) {
            const std::size_t right = (axis + (far ? 1 : 2)) % 3, up = (axis + (far ? 2 : 1)) % 3;
            builder.patch(
                parts[right], parts[up], false,
                [&](std::size_t i, std::size_t k) {
                    std::array<std::size_t, 3> steps{};
                    steps[axis] = far ? parts[axis] : 0, steps[right] = i, steps[up] = k;
                    std::array<double, 3> p{};
                    for (std::size_t j = 0; j < 3; ++j)
                        p[j] = from[j] + size[j] * (static_cast<double>(steps[j]) / static_cast<double>(parts[j]));
                    return Vec3{p[0], p[1], p[2]};
                },
                color);
        }
}

void polish(Scene& scene, std::string_view mesh, float reflectance, float metallic, float roughness) {
    for (Mesh& each : scene.meshes) {
        if (each.name != mesh) continue;
        each.material.reflectance = reflectance;
        each.material.metallic = metallic;
        each.material.roughness = roughness;
    }
}

void drop_slivers(Mesh& mesh) {
    std::erase_if(mesh.triangles, [&](const auto& t) {
        const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        const double longest = std::max({dot(b - a, b - a), dot(c - a, c - a), dot(c - b, c - b)});
        return length(cross(b - a, c - a)) <= 1e-6 * longest;
    });
}

}  // namespace hogel::scene
