// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/analytic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "hogel/error.h"
#include "hogel/scene/analytic_scenes.h"
#include "hogel/scene/mesh_builder.h"

namespace hogel::scene {
namespace {

using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Rgb background{0.02f, 0.02f, 0.03f};

/// Returns picture `number` at p (right) and q (up) from 0 to 1: waves of whole periods, hence tileable.
Rgb picture(int number, double p, double q) {
    const double a = 2 * pi * p, b = 2 * pi * q;
    if (number == 0)
        return {static_cast<float>(0.5 + 0.25 * std::sin(3 * a + b) + 0.2 * std::sin(5 * b - 2 * a)),
                static_cast<float>(0.45 + 0.22 * std::sin(2 * a - 3 * b + 1) + 0.2 * std::cos(4 * a + 3 * b)),
                static_cast<float>(0.5 + 0.25 * std::sin(a + 4 * b + 2) + 0.2 * std::cos(5 * a - b))};
    return {static_cast<float>(0.6 + 0.3 * std::sin(2 * a) * std::sin(2 * b)),
            static_cast<float>(0.4 + 0.3 * std::cos(a + 2 * b)), static_cast<float>(0.3 + 0.2 * std::cos(3 * a - b))};
}

/// A picture in space. Lengths are in units of the hologram's side.
struct Panel {
    int picture;
    double x, y, half_width, depth;
};

constexpr Panel back{0, 0, 0, 0.425, 0.2};
constexpr Panel front{1, -0.05, 0.04, 0.15, -0.1};

constexpr double ball_radius = 0.3;
constexpr Rgb ball_color{0.8f, 0.55f, 0.3f};
constexpr Rgb ball_ambient{0.1f, 0.1f, 0.12f};
constexpr Rgb ball_irradiance{2.4f, 2.3f, 2.1f};
const Vec3 to_lamp = normalize({-0.5, 0.6, 0.7});

constexpr double dot_x = 0.1, dot_y = 0.05, dot_depth = 0.15, dot_radius = 0.005;

/// Returns a texture whose bilinear interpolation is within 2e-4 of picture().
std::shared_ptr<const Image> picture_texture(int number) {
    constexpr std::size_t texels = 512;
    auto image = std::make_shared<Image>(texels, texels, 3);
    for (std::size_t row = 0; row < texels; ++row)
        for (std::size_t column = 0; column < texels; ++column) {
            const Rgb c = picture(number, (static_cast<double>(column) + 0.5) / texels,
                                  1 - (static_cast<double>(row) + 0.5) / texels);
            image->pixels(row, column, 0) = c.r;
            image->pixels(row, column, 1) = c.g;
            image->pixels(row, column, 2) = c.b;
        }
    return image;
}

/// Returns the panel as a mesh; in ambient light of radiance 1 its radiance equals its texture.
Mesh panel_mesh(const Panel& panel, double size) {
    constexpr std::size_t cells = 8;
    MeshBuilder builder;
    const auto part = [](std::size_t i) { return static_cast<double>(i) / cells; };
    builder.patch(
        cells, cells, false,
        [&](std::size_t i, std::size_t k) {
            return size * Vec3{panel.x + panel.half_width * (2 * part(i) - 1),
                               panel.y + panel.half_width * (2 * part(k) - 1), -panel.depth};
        },
        [](Vec3) {
            return Rgb{1, 1, 1};
        });
    Mesh mesh = std::move(builder.mesh);
    for (std::size_t k = 0; k <= cells; ++k)
        for (std::size_t i = 0; i <= cells; ++i)
            mesh.texture_coordinates.push_back({static_cast<float>(part(i)), static_cast<float>(part(k))});
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    mesh.material.base_color = {1, 1, 1};
    mesh.material.base_color_texture = picture_texture(panel.picture);
    mesh.name = panel.picture == 0 ? "back" : "front";
    return mesh;
}

Scene panel_scene(std::initializer_list<Panel> panels, double size) {
    Scene scene;
    for (const Panel& panel : panels) scene.meshes.push_back(panel_mesh(panel, size));
    scene.ambient = {1, 1, 1};
    scene.background = background;
    return scene;
}

// The terminator is a ring of vertices around the light's axis: the kink of max(0, n·l) is between triangles.
Mesh sphere_mesh(double size) {
    constexpr std::size_t columns = 240, rows = 160;
    const Vec3 side = normalize(cross({0, 1, 0}, to_lamp)), other = cross(to_lamp, side);
    Mesh mesh;
    const auto add = [&](Vec3 normal) {
        mesh.normals.push_back(normal);
        mesh.positions.push_back(size * ball_radius * normal);
        return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    };
    const auto ring = [&](std::size_t k, std::size_t i) {
        return 1 + static_cast<std::uint32_t>((k - 1) * columns + i % columns);
    };
    const std::uint32_t south = add(-to_lamp);
    for (std::size_t k = 1; k < rows; ++k)
        for (std::size_t i = 0; i < columns; ++i) {
            const double polar = pi * static_cast<double>(k) / rows, angle = 2 * pi * static_cast<double>(i) / columns;
            add(-std::cos(polar) * to_lamp + std::sin(polar) * (std::cos(angle) * side + std::sin(angle) * other));
        }
    const std::uint32_t north = add(to_lamp);
    for (std::size_t i = 0; i < columns; ++i) {
        mesh.triangles.push_back({south, ring(1, i + 1), ring(1, i)});
        for (std::size_t k = 1; k + 1 < rows; ++k) {
            mesh.triangles.push_back({ring(k, i), ring(k, i + 1), ring(k + 1, i + 1)});
            mesh.triangles.push_back({ring(k, i), ring(k + 1, i + 1), ring(k + 1, i)});
        }
        mesh.triangles.push_back({ring(rows - 1, i), ring(rows - 1, i + 1), north});
    }
    mesh.material.base_color = ball_color;
    mesh.name = "ball";
    return mesh;
}

void see_panel(const Panel& panel, double s, double t, double U, double V, AnalyticSample& sample) {
    const double x = s + U * panel.depth - panel.x, y = t + V * panel.depth - panel.y;
    const double inside = panel.half_width - std::max(std::abs(x), std::abs(y));
    sample.clearance = std::min(sample.clearance, std::abs(inside));
    if (inside < 0 || panel.depth > sample.depth) return;
    sample.depth = panel.depth;
    sample.radiance = picture(panel.picture, 0.5 + 0.5 * x / panel.half_width, 0.5 + 0.5 * y / panel.half_width);
}

// The ray is (s, t, 0) + ζ (U, V, −1).
void see_ball(double s, double t, double U, double V, AnalyticSample& sample) {
    const Vec3 origin{s, t, 0}, direction{U, V, -1};
    const double nearest = -dot(origin, direction) / dot(direction, direction);
    const double distance = length(origin + nearest * direction);
    sample.clearance = std::abs(ball_radius - distance);
    if (distance > ball_radius) return;
    sample.depth = nearest - std::sqrt((ball_radius * ball_radius - distance * distance) / dot(direction, direction));
    const Vec3 normal = (origin + sample.depth * direction) / ball_radius;
    sample.radiance =
        ball_color * (ball_ambient + static_cast<float>(std::max(0.0, dot(normal, to_lamp)) / pi) * ball_irradiance);
}

void see_dot(double s, double t, double U, double V, AnalyticSample& sample) {
    const double distance = std::hypot(s + U * dot_depth - dot_x, t + V * dot_depth - dot_y);
    sample.clearance = std::abs(dot_radius - distance);
    if (distance > dot_radius) return;
    sample.depth = dot_depth;
    sample.radiance = {1, 1, 1};
}

}  // namespace

Scene make_plane(double size) { return panel_scene({back}, size); }
Scene make_two_planes(double size) { return panel_scene({back, front}, size); }

Scene make_sphere(double size) {
    Scene scene;
    scene.meshes.push_back(sphere_mesh(size));
    Light lamp;
    lamp.direction = -to_lamp;
    lamp.intensity = ball_irradiance;
    scene.lights.push_back(lamp);
    scene.ambient = ball_ambient;
    scene.background = background;
    return scene;
}

Scene make_point(double size) {
    constexpr std::uint32_t corners = 96;
    Scene scene;
    Mesh mesh;
    const Vec3 center{dot_x, dot_y, -dot_depth};
    mesh.positions.push_back(size * center);
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * pi * i / corners;
        mesh.positions.push_back(size * (center + dot_radius * Vec3{std::cos(angle), std::sin(angle), 0}));
        mesh.triangles.push_back({0, i + 1, (i + 1) % corners + 1});
    }
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    mesh.material.base_color = {0, 0, 0};
    mesh.material.emission = {1, 1, 1};
    mesh.name = "point";
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

bool has_analytic_radiance(std::string_view name) {
    return name == "plane" || name == "two-planes" || name == "sphere" || name == "point";
}

AnalyticSample analytic_radiance(std::string_view name, double hologram_size, double s, double t, double U, double V) {
    AnalyticSample sample{background, infinity, infinity};
    s /= hologram_size;
    t /= hologram_size;
    if (name == "plane") {
        see_panel(back, s, t, U, V, sample);
    } else if (name == "two-planes") {
        see_panel(back, s, t, U, V, sample);
        see_panel(front, s, t, U, V, sample);
    } else if (name == "sphere") {
        see_ball(s, t, U, V, sample);
    } else if (name == "point") {
        sample.radiance = {0, 0, 0};
        see_dot(s, t, U, V, sample);
    } else {
        throw Error(ErrorCode::usage, fmt::format("scene '{}' has no closed form; expected plane, two-planes, sphere "
                                                  "or point",
                                                  name));
    }
    sample.depth *= hologram_size;
    sample.clearance *= hologram_size;
    return sample;
}

}  // namespace hogel::scene
