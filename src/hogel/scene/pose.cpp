// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hogel/error.h"
#include "hogel/scene.h"

namespace hogel {
namespace {

/// A rotation, by the images of the axes.
struct Rotation {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    Vec3 operator()(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
};

Rotation after(const Rotation& second, const Rotation& first) {
    return {second(first.x), second(first.y), second(first.z)};
}

Rotation about_axes(Vec3 angles) {
    const auto [ax, ay, az] = angles;
    const Rotation x{{1, 0, 0}, {0, std::cos(ax), std::sin(ax)}, {0, -std::sin(ax), std::cos(ax)}};
    const Rotation y{{std::cos(ay), 0, -std::sin(ay)}, {0, 1, 0}, {std::sin(ay), 0, std::cos(ay)}};
    const Rotation z{{std::cos(az), std::sin(az), 0}, {-std::sin(az), std::cos(az), 0}, {0, 0, 1}};
    return after(z, after(y, x));
}

/// Quarter turns keep coordinates exact. With z up, −y faces the viewer, as in CAD programs.
Rotation with_up(Vec3 up) {
    if (up == Vec3{0, 1, 0}) return {};
    if (up == Vec3{0, -1, 0}) return {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    if (up == Vec3{0, 0, 1}) return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    if (up == Vec3{0, 0, -1}) return {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    if (up == Vec3{1, 0, 0}) return {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
    if (up == Vec3{-1, 0, 0}) return {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    throw Error(ErrorCode::usage, "up", "up: not an axis; expected x, y, z, -x, -y or -z");
}

void scale_and_move(Scene& scene, double scale, Vec3 shift) {
    if (scale == 1 && shift == Vec3{}) return;
    for (Mesh& mesh : scene.meshes)
        for (Vec3& position : mesh.positions) position = scale * position + shift;
    for (Light& light : scene.lights) {
        light.position = scale * light.position + shift;
        if (light.kind == Light::Kind::point) light.intensity = static_cast<float>(scale * scale) * light.intensity;
    }
}

void color(Scene& scene, const ScenePose& pose) {
    bool any = !pose.texture;
    for (Mesh& mesh : scene.meshes) {
        if (pose.texture && mesh.texture_coordinates.empty() && !pose.color) continue;
        mesh.colors.clear();
        mesh.material.base_color = pose.color.value_or(Rgb{1, 1, 1});
        mesh.material.base_color_texture = nullptr;
        mesh.material.base_color_sampling = {};
        if (mesh.radiance.size() == mesh.positions.size() && !mesh.radiance.empty())
            std::ranges::fill(mesh.radiance, mesh.material.base_color);
        if (!pose.texture || mesh.texture_coordinates.empty()) continue;
        mesh.material.base_color_texture = pose.texture;
        any = true;
    }
    if (!any)
        throw Error(ErrorCode::usage, "texture",
                    fmt::format("scene '{}': no texture coordinates; expected some for a texture", scene.name));
}

Mesh level_ground(const Bounds& box, double hologram_width, Rgb base_color) {
    constexpr std::uint32_t squares = 96;  // along each side
    const double width = std::max(hologram_width, 1.5 * (box.high.x - box.low.x)),
                 depth = std::max(width, 1.5 * (box.high.z - box.low.z));
    const double left = 0.5 * (box.low.x + box.high.x - width), back = 0.5 * (box.low.z + box.high.z - depth);
    Mesh ground;
    ground.name = "ground";
    ground.material.base_color = base_color;
    for (std::uint32_t row = 0; row <= squares; ++row)
        for (std::uint32_t column = 0; column <= squares; ++column) {
            ground.positions.push_back({left + width * column / squares, box.low.y, back + depth * row / squares});
            ground.normals.push_back({0, 1, 0});
        }
    for (std::uint32_t row = 0; row < squares; ++row)
        for (std::uint32_t column = 0; column < squares; ++column) {
            const std::uint32_t a = row * (squares + 1) + column, b = a + 1, c = a + squares + 1, d = c + 1;
            ground.triangles.push_back({a, c, d});
            ground.triangles.push_back({a, d, b});
        }
    return ground;
}

}  // namespace

void turn_scene(Scene& scene, const ScenePose& pose) {
    const bool turned = pose.rotation != Vec3{};
    const Vec3 up = pose.up.value_or(scene.up);
    if (!turned && up == Vec3{0, 1, 0}) return;
    const Rotation rotation = turned ? after(about_axes(pose.rotation), with_up(up)) : with_up(up);
    scene.up = {0, 1, 0};
    for (Mesh& mesh : scene.meshes) {
        for (Vec3& position : mesh.positions) position = rotation(position);
        for (Vec3& normal : mesh.normals) normal = rotation(normal);
    }
    for (Light& light : scene.lights) {
        light.position = rotation(light.position);
        light.direction = rotation(light.direction);
    }
}

void place_scene(Scene& scene, const ScenePose& pose, double hologram_width) {
    if (!(pose.scale > 0 && std::isfinite(pose.scale)))
        throw Error(ErrorCode::usage, "scale", fmt::format("scale: {}; expected a number above zero", pose.scale));
    scale_and_move(scene, pose.scale, pose.shift);
    if (pose.color || pose.texture) color(scene, pose);
    if (!pose.lights.empty()) scene.lights = pose.lights;
    if (pose.background) scene.background = *pose.background;
    if (pose.ground) scene.meshes.push_back(level_ground(bounds(scene), hologram_width, *pose.ground));
}

}  // namespace hogel
