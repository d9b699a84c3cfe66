// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "hogel/scene.h"
#include "hogel/scene/shapes.h"
#include "showpieces/showpieces.h"

namespace hogel::showpieces {
namespace {

// Lengths in this file are arbitrary: the chandelier is about 2 wide and hangs from y = 1.25.
using std::numbers::pi;
constexpr double hook = 1.25;

constexpr Rgb gold{0.72f, 0.47f, 0.15f}, old_gold{0.46f, 0.27f, 0.08f}, wax{0.86f, 0.80f, 0.66f};

struct Tier {
    std::size_t arms;
    double first_angle, root, reach, candle;  // root and candle: heights of the arms' roots and the candles' feet
};
constexpr std::array<Tier, 2> tiers{{{10, 0.0, -0.30, 0.86, -0.10}, {6, 0.3, 0.16, 0.52, 0.36}}};

Vec3 outwards(double angle) { return {std::sin(angle), 0, std::cos(angle)}; }
double angle_of(const Tier& tier, std::size_t arm) {
    return tier.first_angle + 2 * pi * static_cast<double>(arm) / static_cast<double>(tier.arms);
}
Vec3 cup(const Tier& tier, std::size_t arm) {
    return tier.reach * outwards(angle_of(tier, arm)) + Vec3{0, tier.candle, 0};
}

/// Returns a point of an arm, which leaves the stem (w = 0), dips and rises to its cup (w = 1) in an S-curve.
Vec3 arm_point(const Tier& tier, std::size_t arm, double w) {
    const double out = 0.05 + (tier.reach - 0.05) * (w - 0.09 * std::sin(2 * pi * w));
    const double height = tier.root + (tier.candle - tier.root - 0.02) * w * w * (3 - 2 * w) -
                          0.27 * tier.reach * std::sin(pi * w) * (1 - 0.35 * w) - 0.07 * std::sin(2 * pi * w);
    return out * outwards(angle_of(tier, arm)) + Vec3{0, height, 0};
}

/// Adds the stem: balls and vases on an axis, from the knob below to the ring above.
void add_stem(scene::MeshBuilder& brass) {
    constexpr std::array<std::pair<double, double>, 16> knots{{{-0.66, 0.0},
                                                               {-0.63, 0.035},
                                                               {-0.59, 0.02},
                                                               {-0.50, 0.13},
                                                               {-0.42, 0.10},
                                                               {-0.36, 0.045},
                                                               {-0.28, 0.11},
                                                               {-0.18, 0.055},
                                                               {-0.05, 0.10},
                                                               {0.06, 0.04},
                                                               {0.15, 0.09},
                                                               {0.24, 0.045},
                                                               {0.40, 0.085},
                                                               {0.58, 0.03},
                                                               {0.66, 0.05},
                                                               {0.72, 0.0}}};
    constexpr std::size_t per_knot = 6, rows = (knots.size() - 1) * per_knot;
    brass.revolve(
        {0, 0, 0}, 48, rows,
        [&](std::size_t k) {
            const std::size_t i = std::min(k / per_knot, knots.size() - 2);
            const double w = static_cast<double>(k - i * per_knot) / per_knot, ease = w * w * (3 - 2 * w);
            const auto [y0, r0] = knots[i];
            const auto [y1, r1] = knots[i + 1];
            return std::pair{r0 + ease * (r1 - r0), y0 + w * (y1 - y0)};
        },
        [](Vec3 p) { return scene::mix(gold, old_gold, 0.5 + 0.5 * std::sin(45 * p.y)); });
}

void add_chain(scene::MeshBuilder& brass) {
    constexpr int links = 7;
    constexpr double step = (hook - 0.06 - 0.70) / links;
    for (int i = 0; i < links; ++i) {
        const double angle = i % 2 == 0 ? 0.3 : 0.3 + 0.5 * pi;
        scene::add_torus(brass, {0, 0.70 + (i + 0.5) * step, 0}, outwards(angle), 0.5 * step, 0.010, 24, 8, gold);
    }
    constexpr std::array<std::pair<double, double>, 6> rose{
        {{0.0, -0.05}, {0.03, -0.05}, {0.06, -0.02}, {0.17, 0.0}, {0.18, 0.02}, {0.0, 0.025}}};
    brass.revolve(
        {0, hook, 0}, 40, rose.size() - 1, [&](std::size_t k) { return rose[k]; }, [](Vec3) { return gold; });
}

/// Adds cup, candle and flame at the end of an arm.
void add_candle(scene::MeshBuilder& brass, scene::MeshBuilder& candles, scene::MeshBuilder& flames, Vec3 foot) {
    constexpr std::array<std::pair<double, double>, 9> bowl{{{0.0, -0.035},
                                                             {0.022, -0.03},
                                                             {0.03, -0.005},
                                                             {0.075, 0.012},
                                                             {0.085, 0.028},
                                                             {0.078, 0.03},
                                                             {0.034, 0.016},
                                                             {0.033, 0.06},
                                                             {0.0, 0.06}}};
    brass.revolve(
        foot, 28, bowl.size() - 1, [&](std::size_t k) { return bowl[k]; }, [](Vec3) { return gold; });
    static constexpr double tall = 0.17;
    candles.revolve(
        foot, 16, 6,
        [](std::size_t k) {
            constexpr std::array<std::pair<double, double>, 7> profile{{{0.0, 0.05},
                                                                        {0.024, 0.05},
                                                                        {0.0235, 0.09},
                                                                        {0.023, 0.13},
                                                                        {0.0225, tall},
                                                                        {0.015, tall + 0.004},
                                                                        {0.0, tall}}};
            return profile[k];
        },
        [](Vec3) { return wax; });
    flames.revolve(
        foot + Vec3{0, tall + 0.012, 0}, 14, 9,
        [](std::size_t k) {
            const double w = static_cast<double>(k) / 9;
            return std::pair{k == 0 || k == 9 ? 0.0 : 0.019 * std::sin(pi * std::pow(w, 0.6)) * (1 - 0.3 * w),
                             0.085 * w};
        },
        [](Vec3) {
            return Rgb{0, 0, 0};
        });
}

/// Adds a faceted drop: a small table on top, a girdle, a long point below.
void add_drop(scene::MeshBuilder& crystal, Vec3 top, double size, std::uint32_t number) {
    constexpr std::size_t sides = 8;
    const double rotation = scene::hashed(number, 3, 5);
    const float bright = static_cast<float>(0.75 + 0.35 * scene::hashed(number, 7, 1));
    const Rgb tint = scene::hashed(number, 1, 9) < 0.12   ? Rgb{0.62f, 0.72f, 0.95f}
                     : scene::hashed(number, 2, 9) < 0.12 ? Rgb{0.95f, 0.78f, 0.66f}
                                                          : Rgb{0.84f, 0.87f, 0.92f};
    crystal.patch(
        sides, 4, true,
        [&](std::size_t i, std::size_t k) {
            constexpr std::array<std::pair<double, double>, 5> profile{
                {{0.0, -2.2}, {0.40, -0.95}, {0.46, -0.7}, {0.14, -0.06}, {0.0, 0.0}}};
            const double angle = 2 * pi * (static_cast<double>(i % sides) / sides + rotation);
            return top + size * Vec3{profile[k].first * std::sin(angle), profile[k].second,
                                     profile[k].first * std::cos(angle)};
        },
        [&](Vec3 p) { return (p.y > top.y - 0.8 * size ? 1.0f : 0.8f) * bright * tint; });
}

/// Adds a string of beads between two points, sagging like a chain.
void add_beads(scene::MeshBuilder& crystal, Vec3 from, Vec3 to, double sag, std::size_t beads, double radius) {
    for (std::size_t i = 0; i < beads; ++i) {
        const double w = (static_cast<double>(i) + 0.5) / static_cast<double>(beads);
        const Vec3 p = from + w * (to - from) - Vec3{0, 4 * sag * w * (1 - w), 0};
        const float bright = i % 2 == 0 ? 1.0f : 0.8f;
        scene::add_ball(crystal, p, i % 2 == 0 ? radius : 0.7 * radius, 8, 6, bright * Rgb{0.84f, 0.87f, 0.92f});
    }
}

/// Adds a drop below each cup and a ring of drops around it, strings of beads between neighbours and up to the crown.
void add_crystal(scene::MeshBuilder& crystal) {
    std::uint32_t number = 0;
    for (const Tier& tier : tiers) {
        for (std::size_t arm = 0; arm < tier.arms; ++arm) {
            const Vec3 here = cup(tier, arm), next = cup(tier, (arm + 1) % tier.arms);
            add_drop(crystal, here - Vec3{0, 0.04, 0}, 0.055, ++number);
            for (int i = 0; i < 10; ++i)
                add_drop(crystal, here + 0.08 * outwards(2 * pi * i / 10) + Vec3{0, 0.014, 0}, 0.024, ++number);
            for (int i = 1; i <= 3; ++i) {
                const Vec3 p = arm_point(tier, arm, 0.2 * i);
                add_drop(crystal, p - Vec3{0, 0.02, 0}, 0.036 + 0.006 * (i == 2), ++number);
            }
            const double out = tier.reach > 0.6 ? 1 : 0.9;
            add_beads(crystal, here + Vec3{0, 0.005, 0}, next + Vec3{0, 0.005, 0}, 0.13, 21, 0.0145);
            const Vec3 middle = 0.5 * (here + next) - Vec3{0, 0.138, 0};
            add_drop(crystal, middle, 0.042, ++number);
            const Vec3 crown{0.07 * out * std::sin(angle_of(tier, arm)), tier.reach > 0.6 ? 0.30 : 0.64,
                             0.07 * out * std::cos(angle_of(tier, arm))};
            add_beads(crystal, crown, here + Vec3{0, 0.01, 0} - 0.07 * outwards(angle_of(tier, arm)), 0.10,
                      tier.reach > 0.6 ? 27 : 17, 0.0135);
        }
        // A curtain of drops around the stem.
        for (std::size_t i = 0; i < 3 * tier.arms; ++i) {
            const double angle =
                tier.first_angle + 2 * pi * static_cast<double>(i) / static_cast<double>(3 * tier.arms);
            add_drop(crystal, 0.15 * outwards(angle) + Vec3{0, tier.root + 0.03, 0}, 0.04, ++number);
        }
    }
    scene::add_ball(crystal, {0, -0.735, 0}, 0.06, 14, 9, {0.84f, 0.87f, 0.92f});
}

void add_arms(const Tier& tier, scene::MeshBuilder& brass, scene::MeshBuilder& candles, scene::MeshBuilder& flames) {
    constexpr std::size_t steps = 44;
    scene::add_torus(brass, {0, tier.root + 0.035, 0}, {0, 1, 0}, 0.15, 0.014, 60, 10, gold);
    for (std::size_t arm = 0; arm < tier.arms; ++arm) {
        scene::add_tube(
            brass, 13, steps, [&](std::size_t k) { return arm_point(tier, arm, static_cast<double>(k) / steps); },
            [](std::size_t k) {
                const double w = static_cast<double>(k) / steps;
                return 0.015 + 0.010 * std::exp(-scene::square(w / 0.1)) +
                       0.009 * std::exp(-scene::square((w - 0.45) / 0.03));
            },
            [](Vec3) { return gold; });
        add_candle(brass, candles, flames, cup(tier, arm));
    }
}

void add_lights(Scene& scene) {
    // Four lamps between the candles replace one lamp per flame.
    for (int i = 0; i < 3; ++i) {
        Light glow;
        glow.kind = Light::Kind::point;
        glow.position = 0.70 * outwards(0.3 + 2 * pi * i / 3) + Vec3{0, 0.22, 0};
        glow.intensity = {1.25f, 0.92f, 0.52f};
        scene.lights.push_back(glow);
    }
    Light crown = scene.lights.front();
    crown.position = {0, 0.62, 0.42};
    crown.intensity = {0.5f, 0.37f, 0.21f};
    Light room;
    room.direction = normalize({0.5, -0.35, -0.8});
    room.intensity = {1.15f, 1.25f, 1.5f};
    scene.lights.insert(scene.lights.end(), {crown, room});
    scene.ambient = {0.12f, 0.11f, 0.11f};
    scene.background = {0.010f, 0.006f, 0.007f};
}

}  // namespace

Scene make_chandelier(double hologram_size) {
    scene::MeshBuilder brass, candles, flames, crystal;
    add_stem(brass);
    add_chain(brass);
    for (const Tier& tier : tiers) add_arms(tier, brass, candles, flames);
    add_crystal(crystal);

    Scene scene;
    brass.mesh.name = "brass", candles.mesh.name = "candles", flames.mesh.name = "flames";
    crystal.mesh.name = "crystal";
    candles.mesh.material.emission = {0.16f, 0.10f, 0.045f};
    flames.mesh.material.emission = {3.2f, 2.1f, 0.85f};
    scene.meshes = {std::move(brass.mesh), std::move(candles.mesh), std::move(flames.mesh), std::move(crystal.mesh)};
    for (Mesh& mesh : scene.meshes) {
        scene::drop_slivers(mesh);
        mesh.material.base_color = {1, 1, 1};
    }
    scene::polish(scene, "brass", 0.04f, 0.6f, 0.4f);
    scene::polish(scene, "candles", 0.03f, 0, 0.5f);
    scene::polish(scene, "crystal", 0.1f, 0, 0.2f);
    add_missing_normals(scene, 0.62);
    add_lights(scene);
    scene::rotate(scene, 0.12, 0.10);
    fit_scene(scene, {hologram_size, hologram_size, 0.94, 0.5});
    return scene;
}

}  // namespace hogel::showpieces
