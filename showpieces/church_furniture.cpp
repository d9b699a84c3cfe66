// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "showpieces/church.h"

namespace hogel::showpieces {
namespace {

using std::numbers::pi;
constexpr Rgb gold{0.70f, 0.46f, 0.14f}, linen{0.86f, 0.84f, 0.79f};

/// Adds a candlestick with candle and flame.
void add_altar_candle(scene::MeshBuilder& wood, scene::MeshBuilder& brass, scene::MeshBuilder& flames, Vec3 foot) {
    brass.revolve(
        {foot.x, 1.665, foot.z}, 16, 9,
        [](std::size_t k) {
            constexpr std::array<std::pair<double, double>, 10> profile{{{0.0, 0.0},
                                                                         {0.085, 0.0},
                                                                         {0.06, 0.03},
                                                                         {0.022, 0.06},
                                                                         {0.022, 0.14},
                                                                         {0.045, 0.17},
                                                                         {0.022, 0.20},
                                                                         {0.065, 0.25},
                                                                         {0.06, 0.265},
                                                                         {0.0, 0.26}}};
            return profile[k];
        },
        [](Vec3) { return gold; });
    scene::add_rod(wood, {foot.x, 1.93, foot.z}, {foot.x, 2.14, foot.z}, 0.028, 10, linen);
    scene::add_ball(flames, {foot.x, 2.19, foot.z}, 0.04, 12, 8, {0, 0, 0});
}

void add_altar_rail(scene::MeshBuilder& wood) {
    const double x = half_length;
    constexpr int posts = 19;
    for (int i = 0; i < posts; ++i) {
        const double z = -2.4 + 4.8 * i / (posts - 1);
        if (std::abs(z) < 0.45) continue;
        wood.revolve(
            {x - 1.75, 0.002, z}, 12, 9,
            [](std::size_t k) {
                if (k == 0 || k == 9) return std::pair{0.0, k == 0 ? 0.0 : 0.72};
                const double w = static_cast<double>(k - 1) / 7;
                return std::pair{0.035 + 0.035 * scene::square(std::sin(2 * pi * w)), 0.72 * w};
            },
            [](Vec3) {
                return Rgb{0.36f, 0.20f, 0.09f};
            });
    }
    for (double side : {-1.0, 1.0})
        scene::add_box(wood, {x - 1.84, 0.725, side > 0 ? 0.45 : -2.5}, {x - 1.66, 0.81, side > 0 ? 2.5 : -0.45}, 0.25,
                       [](Vec3) {
                           return Rgb{0.30f, 0.165f, 0.075f};
                       });
}

}  // namespace

void add_stained_glass(std::array<scene::MeshBuilder, 4>& glass, const Frame& wall, const Opening& opening,
                       double depth, std::uint32_t number) {
    constexpr double lead = 0.012, pane = 0.155;
    const double low = opening.sill + 0.03, high = opening.spring + opening.half_width - 0.03;
    const auto rows = static_cast<std::uint32_t>(std::ceil((high - low) / pane));
    const auto columns = 2 * static_cast<std::uint32_t>(std::ceil(opening.half_width / pane));
    const auto half_width_at = [&](double b) {
        const double above = std::max(0.0, b - opening.spring), r = opening.half_width - 0.02;
        return std::sqrt(std::max(0.0, r * r - above * above));
    };
    for (std::uint32_t k = 0; k < rows; ++k) {
        const double b0 = low + (high - low) * k / rows + lead, b1 = low + (high - low) * (k + 1) / rows - lead;
        const double w0 = half_width_at(b0), w1 = half_width_at(b1);
        for (std::uint32_t i = 0; i < columns; ++i) {
            // Symmetric about the middle, with a medallion in each storey between plain borders.
            const std::uint32_t from_middle = i < columns / 2 ? columns / 2 - 1 - i : i - columns / 2;
            const bool border = from_middle + 1 == columns / 2;
            const double chance = scene::hashed(from_middle, k / 2 * 2 + (k % 5 == 0), number);
            const std::size_t color = border          ? (k % 2 == 0 ? 1 : 0)
                                      : chance < 0.5  ? 0
                                      : chance < 0.7  ? 1
                                      : chance < 0.88 ? 2
                                                      : 3;
            const double left = 2.0 * i / columns - 1, right = 2.0 * (i + 1) / columns - 1;
            const auto corner = [&](double part, double half, double b, double inset) {
                return glass[color].vertex(wall.at(opening.center + part * half + inset, b, -depth),
                                           {0.03f, 0.03f, 0.03f});
            };
            if (w1 * 2 / columns < 3 * lead) continue;
            glass[color].quad(corner(left, w0, b0, lead), corner(right, w0, b0, -lead), corner(right, w1, b1, -lead),
                              corner(left, w1, b1, lead));
        }
    }
}

void add_stars(scene::MeshBuilder& stars) {
    for (std::uint32_t bay = 0; bay < bays; ++bay)
        for (std::uint32_t k = 0; k < 7; ++k)
            for (std::uint32_t i = 0; i < 6; ++i) {
                const double shift = k % 2 == 0 ? 0.25 : 0.75;
                const double x = bay_start(bay) + 0.3 + (bay_length - 0.6) * (i + shift) / 6;
                const double angle = 0.16 + 0.2 * k, size = 0.07;
                const auto [z, y] = vault(angle, -0.015);
                const Vec3 middle{x, y, z}, right{1, 0, 0}, up{0, std::cos(angle), std::sin(angle)};
                const auto hub = stars.vertex(middle, gold);
                std::array<scene::MeshBuilder::Index, 10> rim{};
                for (std::size_t tip = 0; tip < rim.size(); ++tip) {
                    const double around = pi / 5 * static_cast<double>(tip), r = tip % 2 == 0 ? size : 0.4 * size;
                    rim[tip] = stars.vertex(middle + r * std::sin(around) * right + r * std::cos(around) * up, gold);
                }
                // The front faces downwards; seen from there the frame (right, up) is left-handed.
                for (std::size_t tip = 0; tip < rim.size(); ++tip)
                    stars.triangle(hub, rim[(tip + 1) % rim.size()], rim[tip]);
            }
}

void add_floor(scene::MeshBuilder& floor) {
    constexpr double tile = 0.412, near_edge = nave_half + 0.5;
    const auto columns = static_cast<std::uint32_t>(std::lround((2 * half_length + nave_half) / tile));
    const auto rows = static_cast<std::uint32_t>(std::lround((near_edge + aisle_back) / tile));
    for (std::uint32_t k = 0; k < rows; ++k)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const Vec3 corner{-half_length - 0.2 + tile * i, 0, near_edge - tile * k};
            // Beyond the nave the floor has the shape of the apse.
            if (corner.x > half_length &&
                std::hypot(corner.x + 0.5 * tile - half_length, corner.z - 0.5 * tile) > nave_half + 0.35)
                continue;
            const bool border = std::abs(std::abs(corner.z - 0.5 * tile) - 0.5 * tile) < 0.5 * tile;
            const float vary = static_cast<float>(0.86 + 0.28 * scene::hashed(i, k, 3));
            const Rgb dark{0.16f, 0.105f, 0.085f}, light{0.58f, 0.52f, 0.43f}, red{0.36f, 0.13f, 0.085f};
            const Rgb color = vary * (border ? red : (i + k) % 2 == 0 ? light : dark);
            constexpr std::size_t parts = 2;
            floor.patch(
                parts, parts, false,
                [&](std::size_t a, std::size_t b) {
                    return corner +
                           Vec3{tile * static_cast<double>(a) / parts, 0, -tile * static_cast<double>(b) / parts};
                },
                [&](Vec3) { return color; });
        }
}

void add_slab(scene::MeshBuilder& slab) {
    scene::add_box(slab, {-half_length - 0.2, -0.55, -aisle_back - 0.2},
                   {half_length + nave_half + 0.3, -0.10, nave_half + 0.5}, 1.8, [](Vec3) {
                       return Rgb{0.17f, 0.10f, 0.06f};
                   });
}

void add_pews(scene::MeshBuilder& wood) {
    constexpr int rows = 12;
    const auto oak = [](Vec3 p) {
        return scene::mix({0.34f, 0.19f, 0.085f}, {0.22f, 0.115f, 0.05f},
                          0.5 + 0.5 * std::sin(23 * p.y + 5 * std::sin(3 * p.z + p.x)));
    };
    for (int row = 0; row < rows; ++row)
        for (double side : {-1.0, 1.0}) {
            const double x = -half_length + 1.3 + 1.17 * row, z0 = side < 0 ? -2.55 : 0.62, z1 = z0 + 1.93;
            scene::add_box(wood, {x, 0.40, z0 + 0.07}, {x + 0.44, 0.46, z1 - 0.07}, 0.45, oak);
            scene::add_box(wood, {x - 0.06, 0.30, z0 + 0.07}, {x, 0.95, z1 - 0.07}, 0.45, oak);
            scene::add_box(wood, {x - 0.22, 0.62, z0 + 0.07}, {x - 0.065, 0.66, z1 - 0.07}, 0.45, oak);
            for (const double end : {z0, z1 - 0.07}) {
                scene::add_box(wood, {x - 0.1, 0.005, end}, {x + 0.46, 0.62, end + 0.07}, 0.45, oak);
                scene::add_box(wood, {x - 0.1, 0.625, end}, {x + 0.06, 1.05, end + 0.07}, 0.45, oak);
                scene::add_ball(wood, {x - 0.02, 1.09, end + 0.035}, 0.055, 10, 6, {0.30f, 0.17f, 0.075f});
            }
        }
}

void add_choir(Masonry& masonry, scene::MeshBuilder& wood, scene::MeshBuilder& brass, scene::MeshBuilder& flames) {
    constexpr Rgb marble{0.70f, 0.66f, 0.60f};
    const double x = half_length;
    for (int step = 0; step < 3; ++step)
        masonry.box({x - 1.1 + 0.42 * step, 0.01 + 0.19 * step, -2.0 + 0.12 * step},
                    {x + 2.25, 0.195 + 0.19 * step, 2.0 - 0.12 * step}, marble, 0.3);
    masonry.box({x + 0.95, 0.585, -1.2}, {x + 1.7, 1.55, 1.2}, marble, 0.25);
    masonry.box({x + 0.88, 1.555, -1.3}, {x + 1.77, 1.66, 1.3}, linen, 0.2);
    for (std::size_t i = 0; i < altar_candles; ++i) add_altar_candle(wood, brass, flames, altar_candle(i));
    scene::add_box(brass, {x + 1.6, 1.67, -0.05}, {x + 1.68, 3.1, 0.05}, 0.2, [](Vec3) { return gold; });
    scene::add_box(brass, {x + 1.59, 2.52, -0.42}, {x + 1.69, 2.63, 0.42}, 0.2, [](Vec3) { return gold; });
    add_altar_rail(wood);
}

void add_pendants(scene::MeshBuilder& brass, scene::MeshBuilder& globes) {
    for (std::size_t i = 0; i < pendants; ++i) {
        const Vec3 lamp = pendant(i);
        const double top = springing + std::sqrt(scene::square(nave_half) - scene::square(lamp.z)) - 0.01;
        scene::add_rod(brass, lamp + Vec3{0, 0.24, 0}, {lamp.x, top, lamp.z}, 0.018, 8, gold);
        scene::add_ball(globes, lamp, 0.17, 12, 8, {0, 0, 0});
        scene::add_torus(brass, lamp, {0, 1, 0}, 0.2, 0.022, 20, 6, gold);
        scene::add_ball(brass, lamp + Vec3{0, 0.22, 0}, 0.07, 10, 6, gold);
    }
}

}  // namespace hogel::showpieces
