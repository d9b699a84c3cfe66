// SPDX-License-Identifier: Apache-2.0
#include "showpieces/masonry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogel::showpieces {
namespace {

using std::numbers::pi;
constexpr double course = 0.145;  // height of a row of blocks
constexpr double block = 0.3;     // length of a block

std::size_t pieces(double length, double longest) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / longest - 1e-9)));
}

}  // namespace

std::pair<double, double> Opening::outline(std::size_t i, double grow) const {
    const double r = half_width + grow;
    if (i == 0) return {center - r, sill};
    if (i == segments + 2) return {center + r, sill};
    const double angle = pi * static_cast<double>(i - 1) / static_cast<double>(segments);
    return {center - r * std::cos(angle), spring + r * std::sin(angle)};
}

Rgb Masonry::vary(Rgb color, double amount) {
    const std::uint32_t n = blocks_++;
    const auto light = static_cast<float>(1 + amount * (scene::hashed(n, 1, 7) + scene::hashed(n, 2, 7) - 1));
    const auto warm = static_cast<float>(1 + 0.25 * amount * (scene::hashed(n, 3, 7) - 0.5));
    return light * (color * Rgb{warm, 1, 1 / warm});
}

void Masonry::quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Rgb color) {
    faceted.quad(faceted.vertex(a, color), faceted.vertex(b, color), faceted.vertex(c, color),
                 faceted.vertex(d, color));
}

void Masonry::flat_patch(Vec3 corner, Vec3 right, Vec3 up, Rgb color, double patch) {
    const std::size_t across = pieces(length(right), patch), rows = pieces(length(up), patch);
    faceted.patch(
        across, rows, false,
        [&](std::size_t i, std::size_t k) {
            return corner + static_cast<double>(i) / static_cast<double>(across) * right +
                   static_cast<double>(k) / static_cast<double>(rows) * up;
        },
        [&](Vec3) { return color; });
}

void Masonry::wall(const Frame& frame, double a0, double a1, double b0, double b1, Rgb stone) {
    if (a1 - a0 < 1e-9 || b1 - b0 < 1e-9) return;
    const std::size_t rows = pieces(b1 - b0, course);
    for (std::size_t k = 0; k < rows; ++k) {
        const double low = b0 + (b1 - b0) * static_cast<double>(k) / static_cast<double>(rows);
        const double high = b0 + (b1 - b0) * static_cast<double>(k + 1) / static_cast<double>(rows);
        // A running bond: joints are half a block apart between neighbouring rows.
        const double shift = k % 2 == 0 ? 0 : 0.5 * block;
        double left = a0;
        while (left < a1 - 1e-9) {
            double right = (std::floor((left - shift) / block + 1e-6) + 1) * block + shift;
            if (right > a1 - 0.2 * block) right = a1;
            quad(frame.at(left, low, 0), frame.at(right, low, 0), frame.at(right, high, 0), frame.at(left, high, 0),
                 vary(stone));
            left = right;
        }
    }
}

void Masonry::wall_with_opening(const Frame& frame, double a0, double a1, double b0, double b1, const Opening& opening,
                                Rgb stone) {
    const double left = opening.center - opening.half_width, right = opening.center + opening.half_width;
    wall(frame, a0, left, b0, b1, stone);
    wall(frame, right, a1, b0, b1, stone);
    wall(frame, left, right, b0, opening.sill, stone);
    const std::size_t rows = pieces(b1 - opening.spring - 0.6 * opening.half_width, 1.5 * course);
    for (std::size_t i = 1; i <= opening.segments; ++i) {
        const auto [x0, y0] = opening.outline(i);
        const auto [x1, y1] = opening.outline(i + 1);
        for (std::size_t k = 0; k < rows; ++k) {
            const double low = static_cast<double>(k) / static_cast<double>(rows);
            const double high = static_cast<double>(k + 1) / static_cast<double>(rows);
            quad(frame.at(x0, y0 + low * (b1 - y0), 0), frame.at(x1, y1 + low * (b1 - y1), 0),
                 frame.at(x1, y1 + high * (b1 - y1), 0), frame.at(x0, y0 + high * (b1 - y0), 0), vary(stone));
        }
    }
}

void Masonry::reveal(const Frame& frame, const Opening& opening, double depth, Rgb stone) {
    const std::size_t points = opening.segments + 3;
    for (std::size_t i = 0; i < points; ++i) {
        const auto [x0, y0] = opening.outline(i);
        const auto [x1, y1] = opening.outline((i + 1) % points);
        const std::size_t parts = pieces(std::hypot(x1 - x0, y1 - y0), 0.2);
        const Vec3 from = frame.at(x0, y0, 0), step = (frame.at(x1, y1, 0) - from) / static_cast<double>(parts);
        for (std::size_t k = 0; k < parts; ++k) {
            const Vec3 a = from + static_cast<double>(k) * step, b = from + static_cast<double>(k + 1) * step;
            quad(b, a, a - depth * frame.out, b - depth * frame.out, vary(stone, 0.12));
        }
    }
}

void Masonry::recess(const Frame& frame, const Opening& opening, double depth, Rgb stone, Rgb pane) {
    reveal(frame, opening, depth, stone);
    const std::uint32_t middle = faceted.vertex(frame.at(opening.center, opening.spring, -depth), pane);
    const std::size_t points = opening.segments + 3;
    for (std::size_t i = 0; i < points; ++i) {
        const auto [x0, y0] = opening.outline(i);
        const auto [x1, y1] = opening.outline((i + 1) % points);
        faceted.triangle(middle, faceted.vertex(frame.at(x1, y1, -depth), pane),
                         faceted.vertex(frame.at(x0, y0, -depth), pane));
    }
}

void Masonry::archivolt(const Frame& frame, const Opening& opening, double width, double projection, Rgb stone) {
    for (std::size_t i = 0; i + 1 < opening.segments + 3; ++i) {
        const std::size_t parts = i == 0 || i == opening.segments + 1 ? 5 : 1;
        for (std::size_t k = 0; k < parts; ++k) {
            const auto corner = [&](double grow, std::size_t at, double c) {
                const auto [x0, y0] = opening.outline(i, grow);
                const auto [x1, y1] = opening.outline(i + 1, grow);
                const double w = static_cast<double>(at) / static_cast<double>(parts);
                return frame.at(x0 + w * (x1 - x0), y0 + w * (y1 - y0), c);
            };
            const Rgb color = vary(stone, 0.15);
            quad(corner(0, k, projection), corner(0, k + 1, projection), corner(width, k + 1, projection),
                 corner(width, k, projection), color);
            quad(corner(width, k, projection), corner(width, k + 1, projection), corner(width, k + 1, 0),
                 corner(width, k, 0), color);
            quad(corner(0, k + 1, projection), corner(0, k, projection), corner(0, k, 0), corner(0, k + 1, 0), color);
        }
    }
}

void Masonry::slab(const Frame& frame, double a0, double a1, double b0, double b1, double projection, Rgb stone) {
    const std::size_t parts = pieces(b1 - b0, 0.3);
    for (std::size_t k = 0; k < parts; ++k) {
        const double low = b0 + (b1 - b0) * static_cast<double>(k) / static_cast<double>(parts);
        const double high = b0 + (b1 - b0) * static_cast<double>(k + 1) / static_cast<double>(parts);
        const Rgb color = vary(stone, 0.15);
        const Vec3 right = (a1 - a0) * frame.right, up = (high - low) * frame.up, out = projection * frame.out;
        const Vec3 foot = frame.at(a0, low, 0);
        flat_patch(foot + out, right, up, color, 0.25);
        flat_patch(foot, out, up, color, 0.25);
        flat_patch(foot + right + out, -out, up, color, 0.25);
        if (k == 0) flat_patch(foot, right, out, color, 0.25);
        if (k + 1 == parts) flat_patch(foot + up + out, right, -out, color, 0.25);
    }
}

void Masonry::box(Vec3 low, Vec3 high, Rgb stone, double patch) {
    const Vec3 size = high - low;
    for (int side = 0; side < 4; ++side) {
        const bool along_x = side % 2 == 0;
        const double far = side < 2 ? 1 : -1;
        const Vec3 out = along_x ? Vec3{0, 0, far} : Vec3{far, 0, 0};
        const Vec3 right = along_x ? Vec3{far, 0, 0} : Vec3{0, 0, -far};
        const Vec3 middle = 0.5 * (low + high);
        const double half = 0.5 * (along_x ? size.x : size.z), half_thickness = 0.5 * (along_x ? size.z : size.x);
        const Vec3 corner = middle + half_thickness * out - half * right - Vec3{0, 0.5 * size.y, 0};
        const std::size_t blocks = pieces(2 * half, 0.45);
        for (std::size_t i = 0; i < blocks; ++i)
            flat_patch(corner + 2 * half * static_cast<double>(i) / static_cast<double>(blocks) * right,
                       2 * half / static_cast<double>(blocks) * right, {0, size.y, 0}, vary(stone, 0.15), patch);
    }
    flat_patch({low.x, high.y, high.z}, {size.x, 0, 0}, {0, 0, -size.z}, stone, patch);
    flat_patch({low.x, low.y, low.z}, {size.x, 0, 0}, {0, 0, size.z}, stone, 2 * patch);
}

void Masonry::quoins(Vec3 foot, double half_width, double height, double block_height, Rgb stone) {
    const std::size_t rows = pieces(height, block_height);
    const double step = height / static_cast<double>(rows);
    for (std::size_t k = 0; k < rows; ++k) {
        const double wide = half_width + (k % 2 == 0 ? 0.03 : 0);
        const double y = foot.y + static_cast<double>(k) * step;
        box({foot.x - wide, y, foot.z - wide}, {foot.x + wide, y + step, foot.z + wide}, stone, 0.3);
    }
}

void Masonry::ring(const Frame& frame, double inner, double outer, double projection, Rgb color, std::size_t segments) {
    for (std::size_t i = 0; i < segments; ++i) {
        const auto at = [&](double r, std::size_t k, double c) {
            const double angle = 2 * pi * static_cast<double>(k % segments) / static_cast<double>(segments);
            return frame.at(r * std::cos(angle), r * std::sin(angle), c);
        };
        if (inner > 0) {
            quad(at(inner, i, projection), at(outer, i, projection), at(outer, i + 1, projection),
                 at(inner, i + 1, projection), color);
            quad(at(inner, i, 0), at(inner, i, projection), at(inner, i + 1, projection), at(inner, i + 1, 0), color);
        } else {
            faceted.triangle(faceted.vertex(at(0, i, projection), color),
                             faceted.vertex(at(outer, i, projection), color),
                             faceted.vertex(at(outer, i + 1, projection), color));
        }
        quad(at(outer, i, projection), at(outer, i, 0), at(outer, i + 1, 0), at(outer, i + 1, projection), color);
    }
}

void Masonry::bar(const Frame& frame, double angle, double r0, double r1, double half_width, double projection,
                  Rgb color) {
    const Vec3 along = std::sin(angle) * frame.right + std::cos(angle) * frame.up;
    const Vec3 across = cross(along, frame.out);
    const Vec3 foot = frame.at(0, 0, projection);
    quad(foot + r0 * along - half_width * across, foot + r0 * along + half_width * across,
         foot + r1 * along + half_width * across, foot + r1 * along - half_width * across, color);
}

void Masonry::pyramid(Vec3 foot, double half_width, double height, std::size_t rows, Rgb tile) {
    const auto level = [&](std::size_t k) {
        const double w = static_cast<double>(k) / static_cast<double>(rows);
        const double flare = 0.06 * std::exp(-w / 0.06);
        return std::pair{half_width * (1 - w + flare) / 1.06, foot.y + height * w};
    };
    for (int side = 0; side < 4; ++side) {
        const double angle = 0.5 * pi * side;
        const Vec3 out{std::sin(angle), 0, std::cos(angle)}, right{std::cos(angle), 0, -std::sin(angle)};
        for (std::size_t k = 0; k < rows; ++k) {
            const auto [r0, y0] = level(k);
            const auto [r1, y1] = level(k + 1);
            const std::size_t tiles = pieces(2 * r0, 0.17);
            for (std::size_t i = 0; i < tiles; ++i) {
                const double left = 2 * static_cast<double>(i) / static_cast<double>(tiles) - 1;
                const double to = 2 * static_cast<double>(i + 1) / static_cast<double>(tiles) - 1;
                const auto at = [&](double r, double y, double w) {
                    return Vec3{foot.x, y, foot.z} + r * out + r * w * right;
                };
                const Rgb color = (k % 2 == 0 ? 1.0f : 0.84f) * vary(tile, 0.3);
                if (r1 > 1e-9)
                    quad(at(r0, y0, left), at(r0, y0, to), at(r1, y1, to), at(r1, y1, left), color);
                else
                    faceted.triangle(faceted.vertex(at(r0, y0, left), color), faceted.vertex(at(r0, y0, to), color),
                                     faceted.vertex({foot.x, y1, foot.z}, color));
            }
        }
    }
}

void Masonry::spire(Vec3 foot, Rgb ball, Rgb point) {
    smooth.revolve(
        foot, 16, 8,
        [](std::size_t k) {
            const double angle = pi * (0.06 + 0.94 * static_cast<double>(k) / 8);
            return std::pair{std::max(0.015, 0.12 * std::sin(angle)), 0.14 - 0.12 * std::cos(angle)};
        },
        [&](Vec3) { return ball; });
    smooth.revolve(
        foot + Vec3{0, 0.25, 0}, 10, 4,
        [](std::size_t k) {
            return std::pair{0.035 * (1 - 0.22 * static_cast<double>(k)), 0.12 * static_cast<double>(k)};
        },
        [&](Vec3) { return point; });
}

void Masonry::hall_side(const Frame& frame, double length, double half_depth, double eaves, double ridge, Rgb stone,
                        Rgb trim, Rgb pane) {
    constexpr std::size_t windows = 4;
    const double half = 0.5 * length, step = length / windows;
    for (std::size_t i = 0; i < windows; ++i) {
        const double a0 = -half + step * static_cast<double>(i);
        const Opening opening{a0 + 0.5 * step, 0.26, 0.75, 1.5, 9};
        wall_with_opening(frame, a0, a0 + step, 0, eaves, opening, stone);
        recess(frame, opening, 0.16, 0.8f * stone, pane);
        archivolt(frame, opening, 0.09, 0.05, trim);
        slab(frame, a0 - 0.1, a0 + 0.1, 0, eaves - 0.3, 0.2, trim);
    }
    slab(frame, half - 0.1, half + 0.1, 0, eaves - 0.3, 0.2, trim);
    slab(frame, -half, half, 0, 0.25, 0.1, trim);
    slab(frame, -half, half, eaves - 0.15, eaves, 0.12, trim);
    // The roof: rows of tiles from the eaves to the ridge.
    constexpr std::size_t rows = 14;
    const std::size_t tiles = pieces(length + 0.2, 0.19);
    for (std::size_t k = 0; k < rows; ++k)
        for (std::size_t i = 0; i < tiles; ++i) {
            const auto at = [&](std::size_t column, std::size_t row) {
                const double w = static_cast<double>(row) / rows;
                return frame.at((2 * static_cast<double>(column) / static_cast<double>(tiles) - 1) * (half + 0.1),
                                eaves + (ridge - eaves) * w, 0.18 - (half_depth + 0.18) * w);
            };
            quad(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1),
                 (k % 2 == 0 ? 1.0f : 0.86f) * vary({0.36f, 0.15f, 0.085f}, 0.35));
        }
}

void Masonry::hall_gable(const Frame& frame, double half_depth, double eaves, double ridge, Rgb stone) {
    wall(frame, -half_depth, half_depth, 0, eaves, stone);
    constexpr std::size_t rows = 10;
    for (std::size_t k = 0; k < rows; ++k) {
        const double w0 = static_cast<double>(k) / rows, w1 = static_cast<double>(k + 1) / rows;
        const double r0 = half_depth * (1 - w0), r1 = half_depth * (1 - w1);
        const double y0 = eaves + (ridge - eaves) * w0, y1 = eaves + (ridge - eaves) * w1;
        const std::size_t blocks = pieces(2 * r0, block);
        for (std::size_t i = 0; i < blocks; ++i) {
            const double left = 2 * static_cast<double>(i) / static_cast<double>(blocks) - 1;
            const double right = 2 * static_cast<double>(i + 1) / static_cast<double>(blocks) - 1;
            const Rgb color = vary(stone);
            if (k + 1 < rows)
                quad(frame.at(left * r0, y0, 0), frame.at(right * r0, y0, 0), frame.at(right * r1, y1, 0),
                     frame.at(left * r1, y1, 0), color);
            else
                faceted.triangle(faceted.vertex(frame.at(left * r0, y0, 0), color),
                                 faceted.vertex(frame.at(right * r0, y0, 0), color),
                                 faceted.vertex(frame.at(0, y1, 0), color));
        }
    }
}

void Masonry::hall(Vec3 foot, double length, double half_depth, double eaves, double ridge, Rgb stone, Rgb trim,
                   Rgb pane) {
    const double middle = foot.x + 0.5 * length;
    for (int side : {1, -1}) {
        const Frame frame{
            {middle, foot.y, foot.z + side * half_depth}, {1.0 * side, 0, 0}, {0, 1, 0}, {0, 0, 1.0 * side}};
        hall_side(frame, length, half_depth, eaves, ridge, stone, trim, pane);
    }
    hall_gable({{foot.x + length, foot.y, foot.z}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, half_depth, eaves, ridge, stone);
}

void Masonry::lawn(Vec3 center, double half_width, double half_depth) {
    constexpr std::size_t columns = 72, rows = 24;
    smooth.revolve(
        center, columns, rows + 1,
        [&](std::size_t k) {
            if (k == 0) return std::pair{0.98, -0.14};
            return std::pair{1 - 0.995 * static_cast<double>(k - 1) / rows, 0.0};
        },
        [](Vec3 p) {
            const double tufts = 0.5 + 0.5 * std::sin(9 * p.x + 3 * std::sin(8 * p.z)) * std::sin(11 * p.z);
            return scene::mix({0.09f, 0.15f, 0.045f}, {0.16f, 0.22f, 0.07f}, tufts);
        });
    const std::size_t first = smooth.mesh.positions.size() - columns * (rows + 2);
    for (std::size_t i = first; i < smooth.mesh.positions.size(); ++i) {
        Vec3& p = smooth.mesh.positions[i];
        p = {center.x + half_width * (p.x - center.x), p.y, center.z + half_depth * (p.z - center.z)};
    }
}

void Masonry::tree(Vec3 foot, double height) {
    smooth.revolve(
        foot, 18, 14,
        [&](std::size_t k) {
            if (k == 0) return std::pair{0.05, 0.0};
            if (k == 1) return std::pair{0.05, 0.12 * height};
            const double w = static_cast<double>(k - 2) / 12;
            const double bump = 1 + 0.10 * std::sin(40 * w + foot.x);
            return std::pair{std::max(0.01, 0.30 * bump * std::pow(std::sin(pi * std::pow(1 - w, 1.4)), 0.8)),
                             height * (0.12 + 0.88 * w)};
        },
        [&](Vec3 p) {
            if (p.y < foot.y + 0.11 * height) return Rgb{0.16f, 0.10f, 0.05f};
            const double leaves = 0.5 + 0.5 * std::sin(19 * p.x + 23 * p.y) * std::sin(17 * p.z + 13 * p.y);
            return scene::mix({0.05f, 0.10f, 0.04f}, {0.13f, 0.19f, 0.06f}, leaves);
        });
}

}  // namespace hogel::showpieces
