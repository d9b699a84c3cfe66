// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/render/ordered_bits.h"

namespace hogel::render::epi {

/// Segment in which an epipolar plane cuts a triangle, between two points (x, z) in the units of an EpipolarFrame, and
/// the samples that it covers. Column n sees point p in direction K if n = c_p(K) with c_p(K) = x_p − K z_p. The span
/// covers sample (n, K) if n lies in (c, c'], where c and c' are the smaller and the larger of c_0 and c_1. Whether n >
/// c_p depends on the point alone, so spans that share a point neither leave a gap nor overlap.
struct EpiSpan {
    float x0, z0, x1, z1;
};

/// Values of a span, linear from end 0 to end 1, in one cache line; the background is a span too.
struct alignas(64) SpanValues {
    float x0, z0, dx, dz;            ///< end 0, and the vector from there to end 1
    float value0[4], difference[4];  ///< R, G, B (or the only channel first), depth ζ in metres
    float unused[4] = {};            ///< fills the line
};

/// Number of adjacent samples of one column in a cell of the hierarchical z.
constexpr std::size_t directions_per_cell = 16;

/// Hierarchical z of a plane: a coarse depth map, columns fastest. Cells at the columns' ends may be smaller.
struct DepthCells {
    /// Farthest depth of the samples of each cell, as ordered bits; all ones while a sample may see the background. A
    /// few entries beyond the last may be read.
    std::vector<std::uint32_t> max_depth;
    /// Number of draws into cells since max_depth was computed; not all kernels count.
    std::size_t writes = 0;

    static std::size_t rows(std::size_t directions) {
        return (directions + directions_per_cell - 1) / directions_per_cell;
    }
    /// Resets all cells, for an empty plane of this size.
    void clear(std::size_t columns, std::size_t directions);
};

/// Samples (n, k) of one epipolar plane, k fastest. A sample is a word: the nearest depth so far as ordered bits in the
/// upper half, the number of its span in the lower half.
struct EpipolarPlane {
    std::uint64_t* words;
    DepthCells* cells;
    std::size_t columns, directions;
    std::int32_t first_column;  ///< n of the first column
    float first_direction;      ///< K of k = 0
    bool fronts_only = false;   ///< whether spans cover only samples that see a front (c_0 < c_1)

    static constexpr std::size_t padding = 64;      ///< words after the last, which may be read and are never changed
    static constexpr std::uint32_t background = 0;  ///< number of its span; others begin at 1
    static constexpr std::uint64_t empty = ~std::uint64_t{0} << 32 | background;
};

/// Destination of a plane's interpolated values: R, G, B and depth ζ in metres, or the only channel first (SpanValues).
/// Column c of value i begins at values[i] + c · strides[i]; its directions are contiguous. A null pointer skips a
/// value.
struct PlaneOutput {
    float* values[4];
    std::size_t strides[4];

    /// Returns whether all rows are aligned to this number of floats.
    bool is_aligned_to(std::size_t floats) const {
        for (int i = 0; i < 4; ++i)
            if (reinterpret_cast<std::uintptr_t>(values[i]) % (floats * sizeof(float)) != 0 || strides[i] % floats != 0)
                return false;
        return true;
    }
};

/// The kernels of the inner loops exist in a plain and a vector version. Both give the same bits, because they do the
/// same operations in the same order, without fused multiply-adds. Vector code may find candidates by a faster method
/// that finds too many; it then applies the same test to them.

/// Draws spans `first`, first + 1, … into a plane. Where span i is nearer than the sample (or as near, with a smaller
/// number), the word becomes ordered_bits(z) · 2³² + i. The vector version may skip samples that the plane's cells
/// occlude.
void draw_spans_plain(std::span<const EpiSpan> spans, std::size_t first, const EpipolarPlane& plane);
extern decltype(draw_spans_plain)& draw_spans;

/// Updates the cells of a plane from everything drawn so far.
void find_max_depths_plain(const EpipolarPlane& plane);
extern decltype(find_max_depths_plain)& find_max_depths;

/// Writes all samples of a plane, interpolated between the ends of their spans, and empties the plane.
void shade_between_ends_plain(const EpipolarPlane& plane, std::span<const SpanValues> spans, const PlaneOutput& out);
extern decltype(shade_between_ends_plain)& shade_between_ends;

/// Returns the position on a span that column n sees in direction K, from 0 at end 0 to 1 at end 1.
inline float position_on_span(const SpanValues& span, float n, float K) {
    const float position = ((n - span.x0) + K * span.z0) / (span.dx - K * span.dz);
    // In this order the comparisons also turn NaN into 0. It occurs if both ends are the same point.
    const float positive = position > 0 ? position : 0;
    return positive < 1 ? positive : 1;
}

}  // namespace hogel::render::epi
