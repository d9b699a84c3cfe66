// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "hogel/scene.h"
#include "hogel/scene/shapes.h"
#include "showpieces/carve.h"
#include "showpieces/showpieces.h"

namespace hogel::showpieces {
namespace {

// Lengths in this file are arbitrary (the pumpkin is about one unit in radius); fit_scene gives them their size.
using std::numbers::pi;
constexpr int ribs = 14;
constexpr double height = 0.78;        // height of the body above its middle
constexpr double depth_squash = 0.68;  // ratio of the depth to the width
constexpr double wall = 0.1;
constexpr Vec3 flame_tip{0.03, -0.27, 0.12};

/// Returns the depth of the groove between two ribs at an azimuth: 1 at its bottom, 0 on the ribs.
double groove(double azimuth) {
    const double s = std::sin(0.5 * ribs * (azimuth + pi / ribs) + 0.35 * std::sin(3 * azimuth + 1));
    return scene::square(1 - std::sqrt(s * s + 0.004) / std::sqrt(1.004));
}

/// Returns a point of the body at an azimuth (0 in front) and an elevation, `thickness` below the skin.
Vec3 body(Parameter at, double thickness) {
    const double around = std::cos(at.b), up = std::sin(at.b);
    const double inner = thickness / wall;  // grooves fade towards the inside
    const double rib = 1 - (0.17 - 0.1 * inner) * groove(at.a) * std::pow(std::abs(around), 0.35);
    const double dimple = 0.30 * std::exp(-scene::square(around / 0.38)) * (up > 0 ? 1 : 0.75);
    const double radius = rib * std::pow(std::abs(around), 0.88) * (1 - thickness * 1.05) * (1 - 0.05 * up);
    const double lumps = 1 + 0.012 * std::sin(5 * at.a + 7 * at.b) + 0.01 * std::sin(3 * at.a - 4 * at.b + 2);
    return {lumps * radius * std::sin(at.a), height * up * (1 - dimple) * (1 - 1.3 * thickness) * (0.94 + 0.06 * rib),
            depth_squash * lumps * radius * std::cos(at.a)};
}

Rgb skin_color(Parameter at) {
    constexpr Rgb orange{0.86f, 0.235f, 0.022f}, dark{0.50f, 0.095f, 0.008f}, yellow{0.93f, 0.33f, 0.035f},
        green{0.20f, 0.24f, 0.04f};
    Rgb color =
        scene::mix(orange, yellow, 0.5 + 0.5 * std::sin(9 * at.a + 3 * std::sin(4 * at.b)) * std::sin(6 * at.b + at.a));
    color = scene::mix(color, dark, 1.15 * std::sqrt(groove(at.a)) - 0.1);
    const double near_stem = (at.b - 0.95) / 0.45 + 0.25 * groove(at.a);
    color = scene::mix(color, green, 0.75 * near_stem);
    return scene::mix(color, {0, 0, 0}, 0.10 * (0.5 + 0.5 * std::sin(31 * at.a) * std::sin(23 * at.b)));
}

std::vector<std::vector<Parameter>> face() {
    std::vector<std::vector<Parameter>> holes;
    for (int side : {-1, 1}) {
        const auto x = [side](double a) { return side * a; };
        holes.push_back({{x(0.70), 0.23}, {x(0.42), 0.155}, {x(0.15), 0.17}, {x(0.33), 0.60}});
    }
    holes.push_back({{-0.105, -0.06}, {0.105, -0.06}, {0, 0.125}});

    // The mouth: an upper lip from left to right with two teeth, and a lower lip back with one.
    const auto upper = [](double a) { return -0.245 + 0.47 * a * a; };
    const auto lower = [](double a) { return -0.66 + 1.21 * a * a; };
    std::vector<Parameter> mouth;
    const auto lip = [&mouth](double from, double to, auto&& curve) {
        const int steps = std::max(1, static_cast<int>(std::abs(to - from) / 0.04));
        for (int i = 0; i < steps; ++i) {
            const double a = from + (to - from) * i / steps;
            mouth.push_back({a, curve(a)});
        }
    };
    const auto tooth = [&mouth](double from, double to, double length, auto&& curve) {
        mouth.push_back({from, curve(from)});
        mouth.push_back({from + 0.12 * (to - from), curve(from) + length});
        mouth.push_back({to - 0.12 * (to - from), curve(to) + length});
    };
    constexpr double corner = 0.75;
    lip(-corner, -0.40, upper);
    tooth(-0.40, -0.20, -0.14, upper);
    lip(-0.20, 0.20, upper);
    tooth(0.20, 0.40, -0.14, upper);
    lip(0.40, corner, upper);
    lip(corner, 0.11, lower);
    tooth(0.11, -0.11, 0.15, lower);
    lip(-0.11, -corner, lower);
    holes.push_back(std::move(mouth));
    return holes;
}

void append_steps(std::vector<double>& values, double to, int steps) {
    const double from = values.back();
    for (int i = 1; i <= steps; ++i) values.push_back(from + (to - from) * i / steps);
}

CarvedGrid carved_body() {
    std::vector<double> columns{-pi + 0.13};
    append_steps(columns, -1.9, 6);
    append_steps(columns, -0.92, 11);
    append_steps(columns, 0.92, 38);
    append_steps(columns, 1.9, 11);
    append_steps(columns, pi - 0.13, 6);
    std::vector<double> rows{-0.5 * pi};
    append_steps(rows, -0.74, 6);
    append_steps(rows, 0.68, 31);
    append_steps(rows, 0.5 * pi, 9);
    const auto holes = face();
    return carve(columns, rows, holes);
}

Mesh skin(const CarvedGrid& grid) {
    scene::MeshBuilder builder;
    for (Parameter p : grid.points) builder.vertex(body(p, 0), skin_color(p));
    builder.mesh.triangles = grid.triangles;
    builder.mesh.name = "skin";
    return std::move(builder.mesh);
}

/// Returns the inner wall and the cut through the wall. They emit some light, because flesh is translucent.
Mesh flesh(const CarvedGrid& grid) {
    constexpr Rgb pale{0.95f, 0.60f, 0.20f}, rind{0.90f, 0.38f, 0.07f};
    constexpr std::uint32_t layers = 2;
    scene::MeshBuilder builder;
    for (Parameter p : grid.points)
        builder.vertex(body(p, wall), scene::mix(pale, rind, 0.3 + 0.3 * std::sin(17 * p.a + 5 * std::sin(9 * p.b))));
    for (const auto& [a, b, c] : grid.triangles) builder.triangle(a, c, b);
    for (const auto& [a, b] : grid.rims) {
        const auto step = [&](std::uint32_t end, std::uint32_t layer) {
            const double w = static_cast<double>(layer) / layers;
            const Vec3 out = body(grid.points[end], 0), in = body(grid.points[end], wall);
            const Vec3 p = layer == 0 ? out : layer == layers ? in : out + w * (in - out);
            return builder.vertex(p, scene::mix(rind, pale, 0.4 + w));
        };
        for (std::uint32_t layer = 0; layer < layers; ++layer)
            builder.quad(step(b, layer), step(a, layer), step(a, layer + 1), step(b, layer + 1));
    }
    builder.mesh.material.emission = {0.16f, 0.052f, 0.006f};
    builder.mesh.name = "flesh";
    return std::move(builder.mesh);
}

/// Returns a bent, twisted, five-ridged stalk with a flared foot.
Mesh stem() {
    constexpr std::size_t columns = 25, rows = 12;
    constexpr Rgb green{0.22f, 0.25f, 0.07f}, brown{0.30f, 0.20f, 0.08f}, cut{0.55f, 0.47f, 0.25f};
    const auto middle = [](double w) {
        return Vec3{0.02 + 0.16 * w * w, 0.44 + 0.46 * w - 0.05 * w * w, -0.04 * w * w};
    };
    const auto at = [&](double angle, double w, double widen) {
        const double flare = 0.085 + 0.14 * std::exp(-w / 0.13) + 0.02 * w;
        const double radius = widen * flare * (1 + 0.17 * std::cos(5 * angle + 1.2 * w));
        const Vec3 along = normalize(middle(w + 0.01) - middle(w - 0.01));
        const Vec3 right = normalize(cross(along, {0, 0, 1})), front = cross(right, along);
        return middle(w) + radius * (std::sin(angle) * right + std::cos(angle) * front);
    };
    scene::MeshBuilder builder;
    const auto angle = [](std::size_t i) { return 2 * pi * static_cast<double>(i % columns) / columns; };
    for (std::size_t k = 0; k <= rows; ++k)
        for (std::size_t i = 0; i < columns; ++i) {
            const double w = static_cast<double>(k) / rows;
            builder.vertex(at(angle(i), w, 1),
                           scene::mix(scene::mix(green, brown, 1.1 * w - 0.2), {0.05f, 0.06f, 0.02f},
                                      0.45 - 0.45 * std::cos(5 * angle(i) + 1.2 * w)));
        }
    const auto index = [](std::size_t i, std::size_t k) {
        return static_cast<std::uint32_t>(k * columns + i % columns);
    };
    for (std::size_t k = 0; k < rows; ++k)
        for (std::size_t i = 0; i < columns; ++i)
            builder.quad(index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k + 1));
    const std::uint32_t tip = builder.vertex(middle(1) + Vec3{0.005, 0.012, 0}, cut);
    for (std::size_t i = 0; i < columns; ++i) {
        const std::uint32_t a = builder.vertex(at(angle(i), 1, 1), cut),
                            b = builder.vertex(at(angle(i + 1), 1, 1), cut);
        builder.triangle(a, b, tip);
    }
    builder.mesh.name = "stem";
    return std::move(builder.mesh);
}

Mesh candle() {
    constexpr std::array<std::pair<double, double>, 7> profile{
        {{0.0, -0.58}, {0.1, -0.58}, {0.1, -0.52}, {0.098, -0.46}, {0.09, -0.445}, {0.045, -0.45}, {0.0, -0.455}}};
    scene::MeshBuilder builder;
    builder.revolve(
        {flame_tip.x, 0, flame_tip.z}, 20, profile.size() - 1, [&](std::size_t k) { return profile[k]; },
        [](Vec3) {
            return Rgb{0.05f, 0.035f, 0.02f};
        });
    builder.mesh.material.emission = {0.55f, 0.24f, 0.05f};
    builder.mesh.name = "candle";
    return std::move(builder.mesh);
}

Mesh flame() {
    constexpr std::size_t rows = 8;
    scene::MeshBuilder builder;
    builder.revolve(
        {flame_tip.x, flame_tip.y - 0.17, flame_tip.z}, 14, rows,
        [](std::size_t k) {
            const double w = static_cast<double>(k) / rows;
            return std::pair{0.042 * std::sin(pi * std::pow(w, 0.65)) * (1 - 0.35 * w), 0.16 * w};
        },
        [](Vec3) {
            return Rgb{0, 0, 0};
        });
    builder.mesh.material.emission = {1.6f, 1.05f, 0.42f};
    builder.mesh.name = "flame";
    return std::move(builder.mesh);
}

/// Returns a round slab of slate, with more vertices where shadows and candlelight fall.
Mesh ground() {
    constexpr std::size_t columns = 60, rows = 16;
    constexpr double top = -0.605, radius = 1.09;
    scene::MeshBuilder builder;
    builder.revolve(
        {0, 0, 0}, columns, rows + 3,
        [&](std::size_t k) {
            constexpr double h = 0.07;
            if (k == 0) return std::pair{0.97 * radius, top - h};
            if (k == 1) return std::pair{radius, top - 0.6 * h};
            if (k == 2) return std::pair{radius, top - 0.2 * h};
            const double w = static_cast<double>(k - 3) / rows;
            return std::pair{0.985 * radius * std::pow(1 - w, 0.8), top};
        },
        [](Vec3 p) {
            const double veins = 0.5 + 0.5 * std::sin(7 * p.x + 4 * std::sin(5 * p.z + 3 * p.x));
            return scene::mix({0.17f, 0.165f, 0.18f}, {0.27f, 0.25f, 0.25f}, veins);
        });
    for (Vec3& p : builder.mesh.positions) p.z *= depth_squash;
    builder.mesh.name = "ground";
    return std::move(builder.mesh);
}

}  // namespace

Scene make_pumpkin(double hologram_size) {
    Scene scene;
    const CarvedGrid grid = carved_body();
    scene.meshes = {skin(grid), flesh(grid), stem(), candle(), flame(), ground()};
    for (Mesh& mesh : scene.meshes) {
        scene::drop_slivers(mesh);
        if (mesh.material.emission.r < 1) mesh.material.base_color = {1, 1, 1};
    }
    add_missing_normals(scene, 0.8);

    Light glow;
    glow.kind = Light::Kind::point;
    glow.position = flame_tip;
    glow.intensity = {2.1f, 1.02f, 0.26f};
    Light moon;
    moon.direction = normalize({0.36, -0.78, -0.70});
    moon.intensity = {2.9f, 2.75f, 2.65f};
    scene.lights = {moon, glow};
    scene.ambient = {0.05f, 0.055f, 0.08f};
    scene.background = {0.0045f, 0.0055f, 0.010f};
    scene::rotate(scene, -0.1, 0.22);
    fit_scene(scene, {hologram_size, hologram_size, 0.88, 0.5});
    return scene;
}

}  // namespace hogel::showpieces
