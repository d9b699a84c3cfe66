#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/render/epi_clusters_internal.h"

namespace hogel {

/// What is left of a triangle in an epipolar plane: the segment between two points (x, z), in the units of an
/// EpipolarFrame. Column n sees point p in direction K if n = c_p(K), c_p(K) = x_p − K z_p. The strip covers sample (n,
/// K) if n lies in (c, c'], where c and c' are the smaller and the larger of c_0 and c_1. Whether n > c_p depends on
/// the point alone, so of strips that share a point none leaves a sample out and no two have it.
struct Strip {
    float x0, z0, x1, z1;
};

/// What a strip shows: its ends in full precision, and the values there that are linear along it.
struct StripEnds {
    double x0, x1, z0, z1;
    float value0[4], value1[4];  ///< R, G, B (or the only channel first), depth ζ in metres
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
constexpr std::uint32_t ordered_bits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return bits ^ (bits >> 31 != 0 ? 0xffffffffu : 0x80000000u);
}

/// Where the values of a plane's samples go: the row of directions of column c begins at values[i] + c · strides[i],
/// for each value i of StripEnds; null for a value that nobody wants.
struct ShadedPlane {
    float* values[4];
    std::size_t strides[4];
};

/// The inner loops, each plain and as fast as this processor allows. The twins give the same bits: they do the same
/// operations in the same order, none of them fused, and where vector code finds candidates by a shorter way it finds
/// too many and puts them to the same test.

/// Which triangles of a cluster the plane y = row + slope z separates: bit i for triangle i. A corner is below if
/// (y − slope z) − row < 0.
std::uint64_t crossing_plain(const ClusterCorners& corners, double row, double slope);
std::uint64_t crossing(const ClusterCorners& corners, double row, double slope);

/// Draws strips number `first`, first + 1, … into a plane: wherever strip i is nearer than what is there (or as near,
/// with a smaller number), the word becomes ordered_bits(z) · 2³² + i.
void draw_plain(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane);
void draw(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane);

/// The depths (ordered bits) of the farthest sample of each cell of the plane, directions fastest; all ones where a
/// sample has seen nothing yet. Cells at the far edges of the plane may be smaller.
constexpr std::size_t cell_columns = 8, cell_directions = 16;
void farthest_plain(const EpipolarPlane& plane, std::span<std::uint32_t> cells);
void farthest(const EpipolarPlane& plane, std::span<std::uint32_t> cells);

/// The values of what each sample of the plane sees, by the numbers of the strips; `background` where it sees nothing.
void shade_plain(const EpipolarPlane& plane, std::span<const StripEnds> strips, const float (&background)[4],
                 const ShadedPlane& out);
void shade(const EpipolarPlane& plane, std::span<const StripEnds> strips, const float (&background)[4],
           const ShadedPlane& out);

/// The instruction sets of this processor that the vector kernels are built for, and a way to use but one of them, or
/// with 0 the best again: for tests. Not while kernels run.
std::vector<std::int64_t> kernel_targets();
void use_kernel_target(std::int64_t target);

/// How far along a strip whose points are seen in c0 and c1 column n lies, from 0 to 1. Single precision decided that
/// the sample is covered, which double precision need not confirm.
inline float part_of_strip(double c0, double c1, double n) {
    const double part = (n - c0) / (c1 - c0);
    const double positive = part > 0 ? part : 0;
    return static_cast<float>(positive < 1 ? positive : 1);
}
inline float part_of_strip(const StripEnds& strip, double n, double K) {
    return part_of_strip(strip.x0 - K * strip.z0, strip.x1 - K * strip.z1, n);
}

}  // namespace hogel
