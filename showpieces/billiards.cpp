// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hogel/scene.h"
#include "showpieces/billiards.h"
#include "showpieces/showpieces.h"

namespace hogel::showpieces {
namespace {

// Balls are about twice their real size; otherwise they would be only a few hogels wide.
using std::numbers::pi;
constexpr double ball_radius = 0.062;

struct PlacedBall {
    double x, z;
    Vec3 axis;
};

/// Solids (and the eight) have a white spot at both poles; stripes are white towards both poles and coloured between.
/// Number 0 is the cue ball.
void add_pool_ball(scene::MeshBuilder& builder, int number, const PlacedBall& placed) {
    constexpr Rgb white{0.82f, 0.78f, 0.68f};
    constexpr std::array<Rgb, 8> colors{{{0.02f, 0.02f, 0.02f},
                                         {0.85f, 0.50f, 0.03f},
                                         {0.02f, 0.08f, 0.42f},
                                         {0.66f, 0.04f, 0.02f},
                                         {0.13f, 0.03f, 0.25f},
                                         {0.80f, 0.20f, 0.02f},
                                         {0.02f, 0.23f, 0.09f},
                                         {0.28f, 0.02f, 0.03f}}};
    const Rgb color = number == 0 ? white : colors[static_cast<std::size_t>(number % 8)];
    const double line = number == 0 ? 0.5 : number <= 8 ? 1.18 : 0.56;  // latitude where white begins
    std::vector<scene::Ring> rings{{-0.5 * pi, white}};
    const auto rows = [&](double from, double to, int steps, Rgb c) {
        for (int i = 0; i <= steps; ++i) rings.push_back({from + (to - from) * i / steps, c});
    };
    constexpr double sharp = 0.004;
    const int caps = line > 1 ? 2 : 6, middle = line > 1 ? 18 : 10;
    rows(-0.5 * pi + 0.5 * pi / 26, -line - sharp, caps, white);
    rows(-line, line, middle, color);
    rows(line + sharp, 0.5 * pi - 0.5 * pi / 26, caps, white);
    rings.push_back({0.5 * pi, white});
    scene::add_ball(builder, {placed.x, ball_radius, placed.z}, ball_radius, normalize(placed.axis), 28, rings);
}

/// Returns the balls of a game just after the break.
Mesh balls() {
    constexpr std::array<PlacedBall, 16> places{{{-0.62, 0.24, {0, 1, 0}},
                                                 {0.43, 0.02, {0.3, 0.8, 0.5}},
                                                 {0.58, 0.13, {-0.6, 0.5, 0.6}},
                                                 {-0.10, -0.33, {0.1, 0.4, 0.9}},
                                                 {0.62, -0.15, {0.7, 0.6, 0.3}},
                                                 {0.81, 0.27, {-0.2, 0.7, 0.6}},
                                                 {-0.83, -0.18, {0.5, 0.3, 0.8}},
                                                 {0.14, 0.41, {0.2, 0.9, 0.3}},
                                                 {0.69, 0.005, {-0.3, 0.6, 0.75}},
                                                 {0.36, -0.30, {0.8, 0.5, 0.2}},
                                                 {0.87, -0.24, {-0.5, 0.8, 0.1}},
                                                 {0.80, 0.07, {0.1, 0.95, 0.25}},
                                                 {0.30, 0.19, {0.9, 0.2, 0.3}},
                                                 {1.02, -0.04, {0.4, 0.9, 0.1}},
                                                 {-0.36, 0.03, {-0.7, 0.7, 0.2}},
                                                 {0.98, 0.40, {0.6, 0.7, 0.4}}}};
    scene::MeshBuilder builder;
    for (std::size_t i = 0; i < places.size(); ++i) add_pool_ball(builder, static_cast<int>(i), places[i]);
    scene::drop_slivers(builder.mesh);
    builder.mesh.name = "balls";
    return std::move(builder.mesh);
}

/// Returns the cue, aimed at the cue ball, and the chalk.
Mesh cue() {
    const Vec3 tip{-0.73, 0.085, 0.29}, butt{-1.52, 0.40, 0.74};
    constexpr std::size_t steps = 48;
    constexpr Rgb maple{0.66f, 0.43f, 0.20f}, ebony{0.035f, 0.02f, 0.015f}, ivory{0.80f, 0.75f, 0.62f},
        leather{0.06f, 0.14f, 0.25f};
    const double length_of_cue = length(butt - tip);
    scene::MeshBuilder builder;
    scene::add_tube(
        builder, 20, steps, [&](std::size_t k) { return tip + static_cast<double>(k) / steps * (butt - tip); },
        [](std::size_t k) { return 0.011 + 0.014 * static_cast<double>(k) / steps; },
        [&](Vec3 p) {
            const double w = length(p - tip) / length_of_cue;
            return w < 0.015 ? leather : w < 0.05 ? ivory : w < 0.6 ? maple : std::fmod(w, 0.12) < 0.02 ? ivory : ebony;
        });
    scene::add_box(builder, {-0.11, rail_top, half_width + 0.075}, {-0.06, rail_top + 0.045, half_width + 0.125}, 0.03,
                   [](Vec3 p) {
                       return p.y > rail_top + 0.044 ? Rgb{0.06f, 0.22f, 0.45f} : Rgb{0.03f, 0.09f, 0.30f};
                   });
    scene::drop_slivers(builder.mesh);
    builder.mesh.name = "cue";
    return std::move(builder.mesh);
}

constexpr std::array<double, 3> lamp_places{-0.74, 0, 0.74};
constexpr double lamp_height = 0.86;

/// Adds three lamps on a brass bar, with shades that are green outside and white inside.
void add_lamps(Scene& scene) {
    scene::MeshBuilder outside, inside, brass, bulbs;
    constexpr Rgb gold{0.62f, 0.42f, 0.13f};
    for (double x : lamp_places) {
        const auto shade = [x](bool outer) {
            return [x, outer](std::size_t i, std::size_t k) {
                const double w = static_cast<double>(outer ? k : 12 - k) / 12,
                             angle = 2 * pi * static_cast<double>(i) / 36;
                const double r = 0.045 + 0.215 * std::pow(1 - w, 0.8) - (outer ? 0 : 0.006);
                return Vec3{x + r * std::sin(angle), lamp_height + 0.2 * w, r * std::cos(angle)};
            };
        };
        outside.patch(36, 12, true, shade(true), [](Vec3) { return Rgb{0.015f, 0.16f, 0.075f}; });
        inside.patch(36, 12, true, shade(false), [](Vec3) { return Rgb{0.3f, 0.29f, 0.26f}; });
        scene::add_torus(brass, {x, lamp_height, 0}, {0, 1, 0}, 0.258, 0.008, 40, 8, gold);
        scene::add_ball(brass, {x, lamp_height + 0.22, 0}, 0.05, 20, 10, gold);
        scene::add_rod(brass, {x, lamp_height + 0.2, 0}, {x, lamp_height + 0.38, 0}, 0.013, 12, gold);
        scene::add_ball(bulbs, {x, lamp_height + 0.07, 0}, 0.05, 20, 10, {0, 0, 0});
    }
    scene::add_rod(brass, {-0.98, lamp_height + 0.38, 0}, {0.98, lamp_height + 0.38, 0}, 0.02, 16, gold);
    for (double end : {-1.0, 1.0}) {
        scene::add_ball(brass, {0.98 * end, lamp_height + 0.38, 0}, 0.036, 20, 12, gold);
        scene::add_rod(brass, {0.4 * end, lamp_height + 0.38, 0}, {0.4 * end, lamp_height + 0.62, 0}, 0.011, 12, gold);
    }
    inside.mesh.material.emission = {0.55f, 0.46f, 0.30f};
    bulbs.mesh.material.emission = {3.0f, 2.5f, 1.7f};
    outside.mesh.name = "shades outside", inside.mesh.name = "shades inside";
    brass.mesh.name = "brass", bulbs.mesh.name = "bulbs";
    for (scene::MeshBuilder* builder : {&outside, &inside, &brass, &bulbs}) {
        scene::drop_slivers(builder->mesh);
        scene.meshes.push_back(std::move(builder->mesh));
    }
    for (double x : lamp_places) {
        Light lamp;
        lamp.kind = Light::Kind::point;
        lamp.position = {x, lamp_height + 0.005, 0};
        lamp.intensity = {3.9f, 3.5f, 2.75f};
        scene.lights.push_back(lamp);
    }
}

Mesh carpet() {
    constexpr std::size_t columns = 64, rows = 30;
    scene::MeshBuilder builder;
    builder.revolve(
        {0, floor_height, 0}, columns, rows + 2,
        [](std::size_t k) {
            if (k == 0) return std::pair{1.0, -0.04};
            if (k == 1) return std::pair{1.005, -0.012};
            return std::pair{1 - static_cast<double>(k - 2) / rows, 0.0};
        },
        [](Vec3 p) {
            const double r = std::hypot(p.x, p.z), angle = std::atan2(p.x, p.z);
            constexpr Rgb red{0.20f, 0.025f, 0.03f}, dark{0.09f, 0.012f, 0.022f}, cream{0.42f, 0.31f, 0.17f};
            if (r > 0.93) return scene::mix(cream, red, 0.3);
            if (r > 0.82) return std::sin(36 * angle) > 0 ? dark : scene::mix(red, cream, 0.45);
            return scene::mix(red, dark,
                              0.5 + 0.5 * std::sin(18 * r + 2 * std::sin(12 * angle)) * std::cos(12 * angle));
        });
    for (Vec3& p : builder.mesh.positions) p = {1.62 * p.x, p.y, 1.16 * p.z};
    scene::drop_slivers(builder.mesh);
    builder.mesh.name = "carpet";
    return std::move(builder.mesh);
}

}  // namespace

Scene make_billiards(double hologram_size) {
    Scene scene;
    scene.meshes = {frame(), cloth(), cushions(), pocket_nets(), sights(), balls(), legs(), cue(), carpet()};
    add_lamps(scene);
    for (Mesh& mesh : scene.meshes) mesh.material.base_color = {1, 1, 1};
    scene::polish(scene, "balls", 0.06f, 0, 0.22f);
    scene::polish(scene, "frame", 0.04f, 0, 0.4f);
    scene::polish(scene, "legs", 0.04f, 0, 0.4f);
    scene::polish(scene, "cue", 0.04f, 0, 0.35f);
    scene::polish(scene, "shades outside", 0.05f, 0, 0.3f);
    scene::polish(scene, "brass", 0.04f, 0.6f, 0.35f);
    add_missing_normals(scene, 0.6);

    Light window;
    window.direction = normalize({0.55, -0.45, -0.85});
    window.intensity = {0.62f, 0.72f, 0.95f};
    scene.lights.push_back(window);
    scene.ambient = {0.07f, 0.07f, 0.08f};
    scene.background = {0.006f, 0.005f, 0.006f};
    scene::rotate(scene, -0.42, 0.42);
    fit_scene(scene, {hologram_size, hologram_size, 0.94, 0.5});
    return scene;
}

}  // namespace hogel::showpieces
