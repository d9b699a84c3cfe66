// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "hogel/scene.h"
#include "showpieces/church.h"
#include "showpieces/showpieces.h"

namespace hogel::showpieces {
namespace {

using std::numbers::pi;
constexpr double below_floor = -0.06;  // walls begin here, so that no surface lies in the plane of the floor
constexpr double wall_thickness = 0.62;

constexpr Rgb stone{0.66f, 0.56f, 0.42f}, warm_stone{0.70f, 0.60f, 0.46f}, trim{0.78f, 0.71f, 0.58f},
    section{0.30f, 0.12f, 0.07f};

/// Returns the far wall of the nave, seen from the nave: a is x.
Frame nave_wall() { return {{0, 0, -nave_half}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }

void nave_bay(Masonry& masonry, std::array<scene::MeshBuilder, 4>& glass, std::size_t bay) {
    const double a0 = bay_start(bay), a1 = a0 + bay_length, middle = 0.5 * (a0 + a1);
    const Frame wall = nave_wall();
    const Frame back{{0, 0, -nave_half - wall_thickness}, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    // The arcade: arches on piers, open to the aisle.
    const Opening arch{middle, 1.2, below_floor, 3.75, 16};
    masonry.wall_with_opening(wall, a0, a1, below_floor, triforium_low, arch, stone);
    masonry.wall_with_opening(back, -a1, -a0, below_floor, triforium_low, {-middle, 1.2, below_floor, 3.75, 16}, stone);
    masonry.reveal(wall, arch, wall_thickness, warm_stone);
    masonry.archivolt(wall, {middle, 1.2, 0.02, 3.75, 16}, 0.16, 0.07, trim);
    masonry.archivolt(wall, {middle, 1.42, 3.3, 3.75, 18}, 0.07, 0.04, trim);
    // The triforium: a row of blind arches on little columns.
    constexpr int arches = 5;
    constexpr double step = bay_length / arches;
    for (int i = 0; i < arches; ++i) {
        const double left = a0 + i * step;
        const Opening blind{left + 0.5 * step, 0.21, triforium_low + 0.12, triforium_low + 0.66, 9};
        masonry.wall_with_opening(wall, left, left + step, triforium_low, triforium_high, blind, stone);
        masonry.recess(wall, blind, 0.16, stone, {0.34f, 0.27f, 0.19f});
        masonry.archivolt(wall, blind, 0.06, 0.05, trim);
    }
    masonry.slab(wall, a0, a1, triforium_low - 0.1, triforium_low + 0.04, 0.12, trim);
    masonry.slab(wall, a0, a1, triforium_high - 0.06, triforium_high + 0.06, 0.12, trim);
    // The clerestory.
    const Opening window{middle, 0.72, triforium_high + 0.28, springing - 0.95, 14};
    masonry.wall_with_opening(wall, a0, a1, triforium_high, springing, window, stone);
    masonry.recess(wall, window, 0.34, trim, {0.02f, 0.02f, 0.025f});
    masonry.archivolt(wall, window, 0.12, 0.06, trim);
    add_stained_glass(glass, wall, window, 0.30, static_cast<std::uint32_t>(bay));
    masonry.slab(wall, a0, a1, springing - 0.12, springing + 0.02, 0.16, trim);
}

void aisle_bay(Masonry& masonry, std::array<scene::MeshBuilder, 4>& glass, std::size_t bay) {
    const double a0 = bay_start(bay), a1 = a0 + bay_length, middle = 0.5 * (a0 + a1);
    const Frame wall{{0, 0, -aisle_back}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Opening window{middle, 0.62, 1.5, 3.1, 12};
    masonry.wall_with_opening(wall, a0, a1, below_floor, aisle_height, window, warm_stone);
    masonry.recess(wall, window, 0.3, trim, {0.02f, 0.02f, 0.025f});
    masonry.archivolt(wall, window, 0.12, 0.05, trim);
    add_stained_glass(glass, wall, window, 0.26, static_cast<std::uint32_t>(20 + bay));
    masonry.slab(wall, a0, a1, below_floor, 0.4, 0.16, trim);
}

/// Adds the shafts from the floor to the vault, and the ribs that continue them.
void shafts_and_ribs(scene::MeshBuilder& smooth) {
    constexpr std::array<std::pair<double, double>, 16> profile{{{0.0, 0.0},
                                                                 {0.42, 0.0},
                                                                 {0.42, 0.16},
                                                                 {0.36, 0.2},
                                                                 {0.38, 0.28},
                                                                 {0.29, 0.36},
                                                                 {0.25, 0.42},
                                                                 {0.25, 2.0},
                                                                 {0.25, 3.7},
                                                                 {0.25, 5.4},
                                                                 {0.25, 7.0},
                                                                 {0.25, springing - 0.5},
                                                                 {0.28, springing - 0.42},
                                                                 {0.40, springing - 0.08},
                                                                 {0.40, springing},
                                                                 {0.0, springing}}};
    const auto color = [](Vec3) { return trim; };
    for (std::size_t i = 0; i <= bays; ++i) {
        const double x = bay_start(i);
        smooth.revolve(
            {x, 0, -nave_half + 0.12}, 16, profile.size() - 1, [&](std::size_t k) { return profile[k]; }, color);
        constexpr std::size_t steps = 24;
        scene::add_tube(
            smooth, 10, steps,
            [&](std::size_t k) {
                const auto [z, y] = vault(vault_cut * static_cast<double>(k) / steps, -0.02);
                return Vec3{x, y, z};
            },
            [](std::size_t) { return 0.17; }, color);
        // The near row is cut above its bases.
        smooth.revolve(
            {x, 0, nave_half - 0.12}, 16, 8,
            [&](std::size_t k) {
                return k == 8 ? std::pair{0.0, 0.8} : k == 7 ? std::pair{0.25, 0.8} : profile[k];
            },
            color);
    }
    // The ridge of the vault.
    scene::add_tube(
        smooth, 10, 40,
        [](std::size_t k) {
            const auto [z, y] = vault(0.5 * pi, -0.01);
            return Vec3{-half_length + 2 * half_length * static_cast<double>(k) / 40, y, z};
        },
        [](std::size_t) { return 0.1; }, color);
}

/// Adds a barrel vault of blue plaster from the far wall to slightly beyond its crown, with a roof above.
void barrel(scene::MeshBuilder& smooth, scene::MeshBuilder& stars) {
    constexpr std::size_t columns = 90, rows = 20;
    const auto along = [](std::size_t i) { return half_length * (2 * static_cast<double>(i) / columns - 1); };
    const auto surface = [&](double thickness, bool inside) {
        return [=](std::size_t i, std::size_t k) {
            const auto [z, y] = vault(vault_cut * static_cast<double>(inside ? k : rows - k) / rows, thickness);
            return Vec3{along(i), y, z};
        };
    };
    constexpr double thickness = 0.3;
    smooth.patch(columns, rows, false, surface(0, true), [](Vec3 p) {
        const double cloud = 0.5 + 0.5 * std::sin(2.1 * p.x + std::sin(1.7 * p.z)) * std::sin(1.9 * p.z + p.y);
        return scene::mix({0.075f, 0.115f, 0.33f}, {0.11f, 0.16f, 0.42f}, cloud);
    });
    smooth.patch(
        30, rows, false,
        [=](std::size_t i, std::size_t k) {
            const auto [z, y] = vault(vault_cut * static_cast<double>(rows - k) / rows, thickness);
            return Vec3{half_length * (2 * static_cast<double>(i) / 30 - 1), y, z};
        },
        [](Vec3) { return section; });
    const auto edge = [&](double angle, std::size_t parts, bool flip) {
        smooth.patch(
            parts, 1, false,
            [=](std::size_t i, std::size_t k) {
                const auto [z, y] = vault(angle, (k == 1) == flip ? 0 : thickness);
                return Vec3{half_length * (2 * static_cast<double>(i) / static_cast<double>(parts) - 1), y, z};
            },
            [](Vec3) { return section; });
    };
    edge(vault_cut, 60, false);
    for (double end : {-1.0, 1.0})
        smooth.patch(
            rows, 1, false,
            [=](std::size_t i, std::size_t k) {
                const auto [z, y] =
                    vault(vault_cut * static_cast<double>(i) / rows, (k == 1) == (end > 0) ? 0 : thickness);
                return Vec3{end * half_length, y, z};
            },
            [](Vec3) { return section; });
    add_stars(stars);
}

/// Adds the plaster over the aisle, sloping down to its wall, and a roof.
void aisle_ceiling(scene::MeshBuilder& smooth) {
    constexpr double high = 5.0;
    for (const bool below : {true, false})
        smooth.patch(
            48, 6, false,
            [=](std::size_t i, std::size_t k) {
                const double w = static_cast<double>(below ? k : 6 - k) / 6;
                const double z = -aisle_back + w * (aisle_back - nave_half - wall_thickness);
                return Vec3{half_length * (2 * static_cast<double>(i) / 48 - 1),
                            aisle_height + (high - aisle_height) * std::sin(0.5 * pi * w) + (below ? 0 : 0.2), z};
            },
            [=](Vec3) {
                return below ? Rgb{0.60f, 0.53f, 0.42f} : section;
            });
}

/// Adds five sides of a decagon under a half dome; the near one is cut away.
void apse(Masonry& masonry, std::array<scene::MeshBuilder, 4>& glass, scene::MeshBuilder& mosaic) {
    constexpr int sides = 4;
    for (int side = 0; side < sides; ++side) {
        const double from = pi / 5 * side, to = pi / 5 * (side + 1), half_angle = pi / 10;
        const auto corner = [](double angle) {
            return Vec3{half_length + nave_half * std::sin(angle), 0, -nave_half * std::cos(angle)};
        };
        const Vec3 a = corner(from), b = corner(to), right = normalize(b - a);
        const Frame wall{0.5 * (a + b), right, {0, 1, 0}, cross(right, {0, 1, 0})};
        const double half = nave_half * std::sin(half_angle);
        const Opening window{0, 0.5, 2.0, apse_springing - 1.5, 14};
        masonry.wall_with_opening(wall, -half, half, below_floor, apse_springing, window, warm_stone);
        masonry.recess(wall, window, 0.3, trim, {0.02f, 0.02f, 0.025f});
        masonry.archivolt(wall, window, 0.13, 0.06, trim);
        add_stained_glass(glass, wall, window, 0.26, static_cast<std::uint32_t>(40 + side));
        masonry.slab(wall, -half, half, apse_springing - 0.14, apse_springing, 0.14, trim);
        masonry.slab(wall, -half, half, below_floor, 0.45, 0.14, trim);
        masonry.slab(wall, -half, half, 1.55, 1.67, 0.08, trim);
    }
    constexpr double widest = pi / 5 * sides;
    mosaic.patch(
        48, 24, false,
        [&](std::size_t i, std::size_t k) {
            const double around = widest * static_cast<double>(i) / 48, up = 0.49 * pi * static_cast<double>(k) / 24;
            return Vec3{half_length + nave_half * std::cos(up) * std::sin(around),
                        apse_springing + nave_half * std::sin(up), -nave_half * std::cos(up) * std::cos(around)};
        },
        [](Vec3 p) {
            const double up = (p.y - apse_springing) / nave_half;
            const double rays = std::sin(20 * std::atan2(p.x - half_length, -p.z));
            return up > 0.82 ? Rgb{0.16f, 0.22f, 0.5f}
                             : scene::mix({0.74f, 0.52f, 0.16f}, {0.55f, 0.33f, 0.09f}, 0.5 + 0.5 * rays);
        });
    // The wall over the arch between nave and apse.
    mosaic.patch(
        30, 6, false,
        [](std::size_t i, std::size_t k) {
            const double angle = vault_cut * static_cast<double>(i) / 30, w = static_cast<double>(k) / 6;
            const auto [z, y] = vault(angle, 0);
            return Vec3{half_length - 0.01, (1 - w) * (apse_springing + nave_half * std::sin(angle)) + w * y, z};
        },
        [](Vec3) { return warm_stone; });
}

/// Adds the remaining parts of the west end.
void west_end(Masonry& masonry) {
    const Frame end{{-half_length, 0, 0}, {0, 0, -1}, {0, 1, 0}, {-1, 0, 0}};
    const Frame far_end{{half_length, 0, 0}, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};
    masonry.wall(end, nave_half, nave_half + wall_thickness, below_floor, springing + 0.3, section);
    masonry.wall(far_end, -aisle_back, -nave_half - wall_thickness, below_floor, aisle_height, warm_stone);
}

Light lamp(Vec3 position, Rgb intensity) {
    Light light;
    light.kind = Light::Kind::point;
    light.position = position;
    light.intensity = intensity;
    return light;
}

/// Returns thirty lights: twelve in the nave, six in the aisle, five altar candles, three in the apse, three in the
/// choir, and the sun through the cut.
std::vector<Light> lights() {
    std::vector<Light> list;
    for (std::size_t i = 0; i < pendants; ++i) list.push_back(lamp(pendant(i) - Vec3{0, 0.30, 0}, {5.4f, 4.2f, 2.6f}));
    for (std::size_t bay = 0; bay < bays; ++bay)
        list.push_back(lamp({bay_start(bay) + 0.5 * bay_length, 4.1, -nave_half - 1.4}, {4.4f, 3.4f, 2.1f}));
    for (std::size_t i = 0; i < altar_candles; ++i)
        list.push_back(lamp(altar_candle(i) + Vec3{0, 0.48, 0}, {1.1f, 0.75f, 0.38f}));
    for (int i = 0; i < 3; ++i) {
        const double angle = pi / 5 * (i + 0.5);
        list.push_back(
            lamp({half_length + 0.62 * nave_half * std::sin(angle), 5.2, -0.62 * nave_half * std::cos(angle)},
                 {3.0f, 3.0f, 3.6f}));
    }
    for (int i = 0; i < 3; ++i)
        list.push_back(lamp({half_length - 1.6 + 0.8 * i, 7.3, -1.9 + 0.7 * i}, {3.4f, 2.4f, 1.5f}));
    Light sun;
    sun.direction = normalize({0.62, -0.55, -0.75});
    sun.intensity = {0.95f, 0.85f, 0.68f};
    list.push_back(sun);
    return list;
}

void add_mesh(Scene& scene, scene::MeshBuilder& builder, const char* name, Rgb emission) {
    scene::drop_slivers(builder.mesh);
    builder.mesh.name = name;
    builder.mesh.material.base_color = {1, 1, 1};
    builder.mesh.material.emission = emission;
    scene.meshes.push_back(std::move(builder.mesh));
}

}  // namespace

Scene make_church(double hologram_size) {
    Masonry masonry;
    scene::MeshBuilder smooth, mosaic, floor, slab, wood, brass, stars, globes;
    std::array<scene::MeshBuilder, 4> glass;
    for (std::size_t bay = 0; bay < bays; ++bay) {
        nave_bay(masonry, glass, bay);
        aisle_bay(masonry, glass, bay);
    }
    shafts_and_ribs(smooth);
    barrel(smooth, stars);
    aisle_ceiling(smooth);
    apse(masonry, glass, mosaic);
    west_end(masonry);
    add_floor(floor);
    add_slab(slab);
    add_pews(wood);
    add_choir(masonry, wood, brass, globes);
    add_pendants(brass, globes);

    Scene scene;
    const auto add = [&](scene::MeshBuilder& builder, const char* name, Rgb emission) {
        add_mesh(scene, builder, name, emission);
    };
    add(masonry.faceted, "masonry", {});
    add(smooth, "shafts and vaults", {});
    add(mosaic, "mosaic", {});
    add(floor, "floor", {});
    add(slab, "floor slab", {});
    add(wood, "wood", {});
    add(brass, "brass", {});
    add(stars, "stars", {0.30f, 0.21f, 0.07f});
    add(globes, "globes", {2.6f, 2.0f, 1.2f});
    constexpr std::array<std::pair<const char*, Rgb>, 4> colors{{{"glass, blue", {0.10f, 0.20f, 0.85f}},
                                                                 {"glass, red", {0.75f, 0.06f, 0.05f}},
                                                                 {"glass, gold", {0.95f, 0.60f, 0.12f}},
                                                                 {"glass, green", {0.10f, 0.50f, 0.22f}}}};
    for (std::size_t i = 0; i < glass.size(); ++i) add(glass[i], colors[i].first, colors[i].second);
    scene::polish(scene, "floor", 0.04f, 0, 0.35f);
    scene::polish(scene, "wood", 0.04f, 0, 0.5f);
    scene::polish(scene, "mosaic", 0.04f, 0.4f, 0.5f);
    scene::polish(scene, "brass", 0.04f, 0.6f, 0.4f);
    add_missing_normals(scene, 0.7);
    scene.lights = lights();
    scene.ambient = {0.045f, 0.045f, 0.055f};
    scene.background = {0.006f, 0.007f, 0.011f};
    scene::rotate(scene, 0.3, 0.13);
    fit_scene(scene, {hologram_size, hologram_size, 0.96, 0.5});
    return scene;
}

}  // namespace hogel::showpieces
