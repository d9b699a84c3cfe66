// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "showpieces/billiards.h"

namespace hogel::showpieces {
namespace {

using std::numbers::pi;
constexpr double rail_width = 0.15, corner = 0.11;

/// Returns the colour of wood with grain along a direction: dark lines on a light ground.
Rgb wood(double along, double across, Rgb light, Rgb dark) {
    const double ring = std::sin(46 * across + 3 * std::sin(2.3 * along) + 1.5 * std::sin(11 * across + along));
    return scene::mix(light, dark, 0.5 + 0.32 * ring + 0.18 * std::sin(150 * across + 9 * along));
}

Rgb rosewood(Vec3 p) {
    const bool along_x = std::abs(p.x) / half_length < std::abs(p.z) / half_width;
    return along_x ? wood(p.x, p.z + p.y, {0.33f, 0.125f, 0.05f}, {0.17f, 0.05f, 0.02f})
                   : wood(p.z, p.x + p.y, {0.33f, 0.125f, 0.05f}, {0.17f, 0.05f, 0.02f});
}

/// Path around a rectangle with round corners, offset outwards by `grow`, counterclockwise seen from above.
struct Around {
    double half_x, half_z, radius;
    std::size_t on_corner, on_long, on_short;

    std::size_t count() const { return 4 * on_corner + 2 * (on_long + on_short); }
    std::pair<double, double> operator()(std::size_t i, double grow) const {
        for (int side = 0;; ++side) {
            const bool is_long = side % 2 == 0;
            const std::size_t steps = is_long ? on_long : on_short;
            const double angle_of_side = 0.5 * pi * side, ahead = (is_long ? half_x : half_z) - radius;
            const double out = (is_long ? half_z : half_x) + grow;
            const auto at = [&](double along, double away) {
                return std::pair{along * std::cos(angle_of_side) + away * std::sin(angle_of_side),
                                 away * std::cos(angle_of_side) - along * std::sin(angle_of_side)};
            };
            if (i < steps) return at(ahead * (2 * static_cast<double>(i) / static_cast<double>(steps) - 1), out);
            i -= steps;
            if (i < on_corner) {
                const double angle = 0.5 * pi * static_cast<double>(i) / static_cast<double>(on_corner);
                const double r = radius + grow;
                return at(ahead + r * std::sin(angle), out - r + r * std::cos(angle));
            }
            i -= on_corner;
        }
    }
};

/// Adds a moulding around the table. The profile is a list of distances outwards from the rectangle, and heights.
template <std::size_t n>
void add_moulding(scene::MeshBuilder& builder, const Around& around,
                  const std::array<std::pair<double, double>, n>& profile, Rgb (*color)(Vec3)) {
    builder.patch(
        around.count(), n - 1, true,
        [&](std::size_t i, std::size_t k) {
            const auto [x, z] = around(i % around.count(), profile[k].first);
            return Vec3{x, profile[k].second, z};
        },
        color);
}

/// Centres (x, z) of the pockets; the middle ones lie slightly outside.
constexpr std::array<std::pair<double, double>, 6> pockets{{{-half_length, -half_width},
                                                            {0, -half_width - 0.02},
                                                            {half_length, -half_width},
                                                            {half_length, half_width},
                                                            {0, half_width + 0.02},
                                                            {-half_length, half_width}}};

}  // namespace

Mesh frame() {
    constexpr double w = rail_width;
    constexpr std::array<std::pair<double, double>, 15> profile{{{0.0, -0.02},
                                                                 {0.0, -0.2},
                                                                 {0.6 * w, -0.2},
                                                                 {0.62 * w, -0.17},
                                                                 {0.7 * w, -0.06},
                                                                 {0.72 * w, -0.045},
                                                                 {0.98 * w, -0.035},
                                                                 {w, -0.02},
                                                                 {w, 0.8 * rail_top},
                                                                 {0.97 * w, 0.95 * rail_top},
                                                                 {0.9 * w, rail_top},
                                                                 {0.34 * w, rail_top},
                                                                 {0.3 * w, 0.9 * rail_top},
                                                                 {0.3 * w, -0.02},
                                                                 {0.0, -0.02}}};
    scene::MeshBuilder builder;
    add_moulding(builder, {half_length, half_width, corner, 10, 44, 24}, profile, rosewood);
    builder.mesh.name = "frame";
    return std::move(builder.mesh);
}

Mesh cloth() {
    constexpr std::size_t columns = 90, rows = 48;
    constexpr double over = 0.3 * rail_width;  // overlap under the rails
    scene::MeshBuilder builder;
    builder.patch(
        columns, rows, false,
        [](std::size_t i, std::size_t k) {
            return Vec3{(2 * static_cast<double>(i) / columns - 1) * (half_length + over), 0,
                        -(2 * static_cast<double>(k) / rows - 1) * (half_width + over)};
        },
        [](Vec3 p) {
            const double nap = 0.5 + 0.25 * std::sin(61 * p.x + 5 * std::sin(23 * p.z)) * std::sin(53 * p.z);
            return scene::mix({0.020f, 0.205f, 0.105f}, {0.030f, 0.245f, 0.130f}, nap);
        });
    builder.mesh.name = "cloth";
    return std::move(builder.mesh);
}

Mesh cushions() {
    constexpr std::array<std::pair<double, double>, 6> profile{
        {{0.0, -0.004}, {-0.035, 0.03}, {-0.055, 0.052}, {-0.052, 0.066}, {0.0, rail_top}, {0.045, rail_top}}};
    constexpr std::size_t steps = 26;
    scene::MeshBuilder builder;
    const auto cushion = [&](Vec3 middle, Vec3 right, Vec3 out, double half, double from_jaw, double to_jaw) {
        builder.patch(
            profile.size() - 1, steps, false,
            [&](std::size_t i, std::size_t k) {
                const auto [away, height] = profile[i];
                const double w = static_cast<double>(k) / steps;
                const double left = -half + from_jaw * (-away), end = half - to_jaw * (-away);
                return middle + (left + w * (end - left)) * right + away * out + Vec3{0, height, 0};
            },
            [](Vec3 p) {
                return scene::mix({0.018f, 0.185f, 0.095f}, {0.030f, 0.235f, 0.120f}, 8 * p.y);
            });
    };
    constexpr double mouth = 0.1, side_mouth = 0.085;
    for (double side : {-1.0, 1.0}) {
        for (double part : {-1.0, 1.0}) {
            const double near_end = side * part;  // end at the middle pocket, along `right`
            const Vec3 right{side, 0, 0}, out{0, 0, side};
            const double length = 0.5 * (half_length - mouth - side_mouth);
            const Vec3 middle{part * (side_mouth + length), 0, side * half_width};
            cushion(middle, right, out, length, near_end > 0 ? 0.3 : 1, near_end > 0 ? 1 : 0.3);
        }
        cushion({side * half_length, 0, 0}, {0, 0, -side}, {side, 0, 0}, half_width - mouth, 1, 1);
    }
    builder.mesh.name = "cushions";
    return std::move(builder.mesh);
}

Mesh pocket_nets() {
    scene::MeshBuilder builder;
    for (const auto& [x, z] : pockets) {
        constexpr double radius = 0.085;
        const Vec3 center{x, 0.0015, z};
        builder.patch(
            28, 3, true,
            [&](std::size_t i, std::size_t k) {
                const double angle = 2 * pi * static_cast<double>(i) / 28,
                             r = radius * (1 - static_cast<double>(k) / 3);
                return center + Vec3{r * std::sin(angle), 0, r * std::cos(angle)};
            },
            [](Vec3) {
                return Rgb{0.004f, 0.004f, 0.004f};
            });
        scene::add_torus(builder, {x, rail_top - 0.004, z}, {0, 1, 0}, radius, 0.016, 36, 8, {0.035f, 0.025f, 0.02f});
    }
    scene::drop_slivers(builder.mesh);
    builder.mesh.name = "pockets";
    return std::move(builder.mesh);
}

Mesh sights() {
    scene::MeshBuilder builder;
    const auto sight = [&](double x, double z) {
        scene::add_tube(
            builder, 12, 1,
            [&](std::size_t k) {
                return Vec3{x, rail_top - 0.002 + 0.004 * static_cast<double>(k), z};
            },
            [](std::size_t) { return 0.012; },
            [](Vec3) {
                return Rgb{0.8f, 0.76f, 0.68f};
            });
    };
    constexpr double out = 0.62 * rail_width;
    for (double side : {-1.0, 1.0}) {
        for (int i : {-3, -2, -1, 1, 2, 3}) sight(0.29 * i, side * (half_width + out));
        for (int i : {-1, 0, 1}) sight(side * (half_length + out), 0.3 * i);
    }
    scene::drop_slivers(builder.mesh);
    builder.mesh.name = "sights";
    return std::move(builder.mesh);
}

Mesh legs() {
    constexpr double top = -0.2, height = top - floor_height;
    scene::MeshBuilder builder;
    for (double x : {-1.0, 0.0, 1.0})
        for (double z : {-1.0, 1.0})
            builder.revolve(
                {0.96 * x * half_length, floor_height, 0.92 * z * half_width}, 20, 24,
                [](std::size_t k) {
                    if (k == 0 || k == 24) return std::pair{0.0, k == 0 ? 0.0 : height};
                    const double w = static_cast<double>(k - 1) / 22;
                    const double foot = 0.035 * std::exp(-std::pow((w - 0.05) / 0.06, 2));
                    const double bulge = 0.055 * std::exp(-std::pow((w - 0.68) / 0.16, 2));
                    const double collar = 0.03 * std::exp(-std::pow((w - 0.4) / 0.03, 2));
                    return std::pair{0.052 + foot + bulge + collar + 0.05 * std::pow(w, 8), height * w};
                },
                [](Vec3 p) {
                    return wood(p.y, p.x + p.z, {0.30f, 0.11f, 0.045f}, {0.16f, 0.05f, 0.02f});
                });
    scene::drop_slivers(builder.mesh);
    builder.mesh.name = "legs";
    return std::move(builder.mesh);
}

}  // namespace hogel::showpieces
