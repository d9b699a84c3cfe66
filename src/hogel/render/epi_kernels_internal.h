#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hogel/render/epi_clusters_internal.h"

namespace hogel {

/// What is left of a triangle in an epipolar plane: the segment between two points (x, z), in the units of an
/// EpipolarFrame. Column n sees point p in direction K if n = c_p(K), c_p(K) = x_p − K z_p. The strip covers sample (n,
/// K) if n lies in (c, c'], where c and c' are the smaller and the larger of c_0 and c_1. Whether n > c_p depends on
/// the point alone, so of strips that share a point none leaves a sample out and no two have it.
struct Strip {
    float x0, z0, x1, z1;
};

/// The samples (n, k) of one epipolar plane, k fastest: in each word what is seen first so far, as its depth and the
/// number of its strip.
struct EpipolarPlane {
    std::uint64_t* words;
    std::size_t columns, directions;
    std::int32_t first_column;  ///< n of the first column
    float first_direction;      ///< K of k = 0

    static constexpr std::uint64_t nothing = ~std::uint64_t{0};
};

/// The bits of a float such that unsigned comparison orders them as the floats, also below zero.
inline std::uint32_t ordered_bits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return bits ^ (bits >> 31 != 0 ? 0xffffffffu : 0x80000000u);
}

/// Which triangles of a cluster the plane y = row + slope z separates: bit i for triangle i. A corner is below if
/// (y − slope z) − row < 0.
std::uint64_t crossing_plain(const ClusterCorners& corners, double row, double slope);

/// Draws strips into a plane: wherever strip i is nearer than what is there (or as near, with a smaller number), the
/// word becomes ordered_bits(z) · 2³² + i.
void draw_plain(std::span<const Strip> strips, const EpipolarPlane& plane);

}  // namespace hogel
