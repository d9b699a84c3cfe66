// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "hogel/scene.h"
#include "hogel/scene/shapes.h"
#include "showpieces/masonry.h"
#include "showpieces/showpieces.h"

namespace hogel::showpieces {
namespace {

// Lengths in this file are arbitrary (the shaft is 2 wide and the tower about 12 high); fit_scene gives them their
// size.
using std::numbers::pi;
constexpr double half_width = 1.0;
constexpr double shaft_top = 5.0, clock_top = 6.7, belfry_top = 9.0, eaves = 9.35, roof_top = 12.1;

constexpr Rgb stone{0.55f, 0.45f, 0.33f};
constexpr Rgb trim{0.70f, 0.62f, 0.50f};
constexpr Rgb shade_stone{0.40f, 0.33f, 0.26f};
constexpr Rgb slate{0.20f, 0.25f, 0.24f};
constexpr Rgb copper{0.24f, 0.42f, 0.34f};
constexpr Rgb glass{0.035f, 0.045f, 0.07f};
constexpr Rgb gold{0.80f, 0.55f, 0.16f};

/// Returns the frame of one of the four walls, with its origin at the middle of its foot.
Frame wall_frame(int side, double distance) {
    const double angle = 0.5 * pi * side;
    const Vec3 out{std::sin(angle), 0, std::cos(angle)}, right{std::cos(angle), 0, -std::sin(angle)};
    return {distance * out, right, {0, 1, 0}, out};
}

/// Adds a square course of stone around the tower, which projects from the walls.
void band(Masonry& masonry, double low, double high, double half_side, Rgb color) {
    masonry.box({-half_side, low, -half_side}, {half_side, high, half_side}, color, 0.16);
}

void slit_window(Masonry& masonry, const Frame& wall, double center, double low, double spring, double half) {
    const Opening opening{center, half, low, spring, 7};
    masonry.recess(wall, opening, 0.14, shade_stone, glass);
    masonry.archivolt(wall, opening, 0.09, 0.05, trim);
    masonry.slab(wall, center - half - 0.12, center + half + 0.12, low - 0.1, low, 0.08, trim);
}

void shaft(Masonry& masonry) {
    constexpr double half_window = 0.13;
    for (int side = 0; side < 4; ++side) {
        const Frame wall = wall_frame(side, half_width);
        const std::array<double, 2> sills{1.5, 3.2};
        double low = 0.55;
        for (double sill : sills) {
            const Opening opening{0, half_window, sill, sill + 0.75, 7};
            masonry.wall(wall, -half_width, half_width, low, sill - 0.2, stone);
            masonry.wall_with_opening(wall, -half_width, half_width, sill - 0.2, sill + 1.2, opening, stone);
            slit_window(masonry, wall, 0, sill, sill + 0.75, half_window);
            low = sill + 1.2;
        }
        masonry.wall(wall, -half_width, half_width, low, shaft_top, stone);
    }
    // Buttresses at the corners, in long and short blocks.
    for (int corner = 0; corner < 4; ++corner) {
        const double x = corner % 2 == 0 ? -1 : 1, z = corner / 2 == 0 ? -1 : 1;
        masonry.quoins({0.9 * x, 0.5, 0.9 * z}, 0.2, shaft_top - 0.5, 0.3, trim);
    }
    band(masonry, 0, 0.35, 1.28, shade_stone);
    band(masonry, 0.35, 0.55, 1.18, trim);
    band(masonry, 2.85, 2.97, 1.12, trim);
    band(masonry, shaft_top - 0.14, shaft_top, 1.16, trim);
    band(masonry, shaft_top, shaft_top + 0.12, 1.24, trim);
}

void clock(Masonry& masonry, const Frame& wall, double height) {
    const Frame face{wall.at(0, height, 0.03), wall.right, wall.up, wall.out};
    constexpr Rgb dial{0.85f, 0.82f, 0.72f}, dark{0.05f, 0.045f, 0.05f};
    masonry.ring(face, 0, 0.06, 0.02, dial, 40);
    for (int i = 0; i < 8; ++i) masonry.ring(face, 0.06 + 0.055 * i, 0.115 + 0.055 * i, 0.02, dial, 40);
    masonry.ring(face, 0.5, 0.62, 0.09, gold, 40);
    masonry.ring(face, 0.43, 0.455, 0.03, dark, 40);
    for (int hour = 0; hour < 12; ++hour) {
        const double angle = pi / 6 * hour;
        masonry.bar(face, angle, 0.35, 0.425, hour % 3 == 0 ? 0.028 : 0.015, 0.035, dark);
    }
    masonry.bar(face, 0.3 * pi, -0.08, 0.29, 0.03, 0.05, dark);     // hour hand
    masonry.bar(face, -0.37 * pi, -0.09, 0.42, 0.02, 0.065, dark);  // minute hand
    masonry.ring(face, 0, 0.04, 0.08, gold, 12);
}

void clock_storey(Masonry& masonry) {
    constexpr double low = shaft_top + 0.12, high = clock_top - 0.12;
    for (int side = 0; side < 4; ++side) {
        const Frame wall = wall_frame(side, half_width);
        masonry.wall(wall, -half_width, half_width, low, high, stone);
        for (double edge : {-1.0, 1.0})
            masonry.slab(wall, edge * 0.86 - 0.14, edge * 0.86 + 0.14, low, high, 0.07, trim);
        clock(masonry, wall, 0.5 * (low + high));
    }
    band(masonry, high, clock_top, 1.2, trim);
}

/// Returns the bell: lip, waist and shoulder.
Mesh bell() {
    constexpr std::array<std::pair<double, double>, 13> profile{{{0.0, 0.14},
                                                                 {0.40, 0.02},
                                                                 {0.47, 0.0},
                                                                 {0.485, 0.05},
                                                                 {0.43, 0.16},
                                                                 {0.36, 0.30},
                                                                 {0.32, 0.45},
                                                                 {0.295, 0.60},
                                                                 {0.27, 0.72},
                                                                 {0.21, 0.80},
                                                                 {0.10, 0.84},
                                                                 {0.05, 0.90},
                                                                 {0.05, 1.1}}};
    scene::MeshBuilder builder;
    builder.revolve(
        {0, clock_top + 0.68, 0}, 36, profile.size() - 1, [&](std::size_t k) { return profile[k]; },
        [](Vec3 p) {
            const double belt = std::sin(24 * p.y);
            return scene::mix({0.62f, 0.38f, 0.12f}, {0.80f, 0.52f, 0.18f}, 0.5 + 0.5 * belt);
        });
    builder.mesh.name = "bell";
    return std::move(builder.mesh);
}

void belfry(Masonry& masonry) {
    constexpr double thickness = 0.22, half = 0.62, spring = clock_top + 1.25;
    const Opening arch{0, half, clock_top + 0.02, spring, 20};
    for (int side = 0; side < 4; ++side) {
        const Frame outside = wall_frame(side, half_width);
        const Frame inside{wall_frame(side, half_width - thickness).origin, -outside.right, outside.up, -outside.out};
        masonry.wall_with_opening(outside, -half_width, half_width, clock_top, belfry_top, arch, stone);
        masonry.wall_with_opening(inside, -half_width + thickness, half_width - thickness, clock_top, belfry_top, arch,
                                  shade_stone);
        masonry.reveal(outside, arch, thickness, shade_stone);
        masonry.archivolt(outside, arch, 0.13, 0.06, trim);
        for (double edge : {-1.0, 1.0}) {
            masonry.slab(outside, edge * 0.88 - 0.12, edge * 0.88 + 0.12, clock_top, belfry_top, 0.08, trim);
            masonry.slab(outside, edge * 0.69 - 0.08, edge * 0.69 + 0.08, spring - 0.1, spring + 0.02, 0.10, trim);
        }
        // A balustrade in the arch.
        masonry.slab({outside.at(0, 0, -0.16), outside.right, outside.up, outside.out}, -half, half, clock_top + 0.34,
                     clock_top + 0.42, 0.1, trim);
        for (int i = -3; i <= 3; ++i)
            masonry.slab({outside.at(0, 0, -0.15), outside.right, outside.up, outside.out}, 0.165 * i - 0.03,
                         0.165 * i + 0.03, clock_top, clock_top + 0.34, 0.06, trim);
    }
    masonry.box({-0.8, belfry_top - 0.5, -0.06}, {0.8, belfry_top - 0.36, 0.06}, {0.22f, 0.13f, 0.07f}, 0.2);
    masonry.box({-1.02, belfry_top - 0.02, -1.02}, {1.02, belfry_top, 1.02}, shade_stone, 0.2);
    masonry.box({-0.99, clock_top - 0.02, -0.99}, {0.99, clock_top + 0.005, 0.99}, shade_stone, 0.2);
}

/// Adds the roof with corbels under the eaves, tiles and a finial.
void roof(Masonry& masonry) {
    for (int side = 0; side < 4; ++side) {
        const Frame wall = wall_frame(side, half_width);
        for (int i = -4; i <= 4; ++i)
            masonry.slab(wall, 0.235 * i - 0.055, 0.235 * i + 0.055, belfry_top - 0.02, belfry_top + 0.17, 0.15, trim);
    }
    band(masonry, belfry_top, belfry_top + 0.12, 1.03, stone);
    band(masonry, belfry_top + 0.16, belfry_top + 0.26, 1.2, trim);
    band(masonry, belfry_top + 0.26, eaves, 1.27, trim);
    masonry.pyramid({0, eaves, 0}, 1.22, roof_top - eaves, 34, slate);
    masonry.spire({0, roof_top - 0.12, 0}, gold, copper);
}

}  // namespace

Scene make_tower(double hologram_size) {
    Masonry masonry;
    shaft(masonry);
    clock_storey(masonry);
    belfry(masonry);
    roof(masonry);
    masonry.hall({1.0, 0, 0}, 4.6, 1.7, 2.4, 3.7, stone, trim, glass);
    masonry.lawn({1.5, 0, 0.2}, 5.4, 3.9);
    for (const Vec3 foot :
         {Vec3{-2.0, 0, 1.2}, Vec3{-2.6, 0, -0.4}, Vec3{-1.7, 0, -1.9}, Vec3{3.0, 0, 2.6}, Vec3{4.5, 0, 2.3}})
        masonry.tree(foot, 1.7 + 0.9 * scene::hashed(static_cast<std::uint32_t>(100 + 10 * foot.x), 1, 2));

    Scene scene;
    scene.meshes = {std::move(masonry.faceted.mesh), bell(), std::move(masonry.smooth.mesh)};
    scene.meshes[0].name = "masonry";
    scene.meshes[2].name = "trees and finial";
    for (Mesh& mesh : scene.meshes) {
        scene::drop_slivers(mesh);
        mesh.material.base_color = {1, 1, 1};
    }
    add_missing_normals(scene, 0.7);

    Light sun;
    sun.direction = normalize({0.78, -0.52, -0.55});
    sun.intensity = {4.6f, 3.7f, 2.5f};
    Light sky;
    sky.direction = normalize({-0.5, -0.35, -0.8});
    sky.intensity = {0.28f, 0.36f, 0.55f};
    scene.lights = {sun, sky};
    scene.ambient = {0.10f, 0.12f, 0.18f};
    scene.background = {0.008f, 0.013f, 0.030f};
    scene::rotate(scene, -0.42, 0.17);
    fit_scene(scene, {hologram_size, hologram_size, 0.9, 0.5});
    return scene;
}

}  // namespace hogel::showpieces
