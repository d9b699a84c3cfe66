// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace hogel::render::epi {

/// Point where an edge meets a plane, and the weight of the lone corner (TriangleCut); the other corner has the rest.
struct Crossing {
    double x, z, weight;
};

/// Segment in which a plane cuts a triangle. One of the three corners, `lone`, is alone on its side of the plane. End 0
/// is on the edge from it to the corner `next`, end 1 on the edge to `last`. `next` is chosen such that end 0 is the
/// left one, seen from the triangle's front, where its corners run counterclockwise.
struct TriangleCut {
    std::uint32_t lone, next, last;
    Crossing end0, end1;
};

/// Cuts a triangle by a plane. Corner i is at (x[i], z[i]) and height[i] above the plane; one or two heights are
/// negative. An edge is always cut from its lower to its upper end, so that triangles that share it get the same
/// crossing bit for bit.
inline TriangleCut cut_triangle(const std::array<double, 3>& x, const std::array<double, 3>& z,
                                const std::array<double, 3>& height) {
    // Uses tables and selections, because branches would be unpredictable.
    constexpr std::array<std::uint8_t, 8> alone{0, 0, 1, 2, 2, 1, 0, 0}, after{1, 2, 0}, before{2, 0, 1};
    const unsigned below = unsigned{height[0] < 0} | unsigned{height[1] < 0} << 1 | unsigned{height[2] < 0} << 2;
    const bool upwards = (below & (below - 1)) == 0;
    const std::uint32_t lone = alone[below], next = upwards ? before[lone] : after[lone], last = 3 - lone - next;
    const auto cross = [&](std::uint32_t other) {
        const std::uint32_t low = upwards ? lone : other, high = upwards ? other : lone;
        const double fraction = height[low] / (height[low] - height[high]);
        return Crossing{x[low] + fraction * (x[high] - x[low]), z[low] + fraction * (z[high] - z[low]),
                        upwards ? 1 - fraction : fraction};
    };
    return {lone, next, last, cross(next), cross(last)};
}

}  // namespace hogel::render::epi
