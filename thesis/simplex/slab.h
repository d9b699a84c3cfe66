// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/ordered_bits.h"
#include "hogel/render/row_axes.h"
#include "hogel/render/span.h"
#include "hogel/render/visits.h"

namespace hogel::simplex {

using render::Visits;

// Inner loops of `simploid` over the rays of one V, a slab of the region. Here t and V are the slow axis of RowAxes, s
// and U the fast axis. The kernels exist as twins, a plain and a vector version. Both find the same triangles, test the
// same samples and write the same bits.

/// Data of a triangle for its rays, on two cache lines, because neighbouring rays may see triangles at distant
/// addresses.
struct alignas(64) SlabTriangle {
    std::array<Vec3, 3> corners;
    std::array<Rgb, 3> radiance;  ///< at the corners
    bool needs_samples = false;   ///< ShadedScene::needs_samples()

    void fetch() const {
        __builtin_prefetch(this);
        __builtin_prefetch(reinterpret_cast<const char*>(this) + 64);
    }
};

/// Triangles of a scene, in huge pages if the system grants them.
using SlabTriangles = std::vector<SlabTriangle, CacheLineAllocator<SlabTriangle>>;
/// Returns the triangles of a scene. Reuses the memory of `list`.
SlabTriangles slab_triangles(const ShadedScene& scene, SlabTriangles list = {});

/// 64 triangles, and for each corner two numbers that give the row of hogels from which it is visible: at directions V
/// of slope dy/dζ it is row − slope · depth. Both are in rows of hogels and rounded, so they serve only to skip
/// triangles.
struct alignas(64) TriangleBlock {
    static constexpr std::size_t size = 64;

    float row[3][size], depth[3][size];
    std::uint32_t triangle[size];
    float min_row, max_row, min_depth, max_depth;  ///< ranges over all corners

    TriangleBlock();
    void set(std::size_t i, std::uint32_t index, const std::array<double, 3>& rows,
             const std::array<double, 3>& depths);
};
using TriangleBlocks = std::vector<TriangleBlock, CacheLineAllocator<TriangleBlock>>;

/// Rows of one V, for the search for triangles that cover some of them.
struct SlabRows {
    float slope;
    float last;  ///< index of the last row

    /// Returns the maximum rounding error of the row of a corner, plus the margin of scan conversion.
    float margin(const TriangleBlock& block) const {
        constexpr float rounding = 5e-7f, scan = 2e-6f;  // rounding: eight times half a unit in the last place
        const float rows = std::max(std::abs(block.min_row), std::abs(block.max_row));
        const float depths = std::max(std::abs(block.min_depth), std::abs(block.max_depth));
        return scan + rounding * (rows + std::abs(slope) * depths);
    }

    bool may_show(const TriangleBlock& block) const {
        const float a = slope * block.min_depth, b = slope * block.max_depth, tolerance = margin(block);
        return !(block.max_row - std::min(a, b) < -tolerance || block.min_row - std::max(a, b) > last + tolerance);
    }
};

/// Finds the triangles of a block that may cover one of the rows: all that do, and a few others. Writes their indices
/// in the block's order, and returns their number.
/// @param found  array of TriangleBlock::size elements; elements beyond the returned number are undefined
std::size_t find_in_rows_plain(const TriangleBlock& block, const SlabRows& rows, std::uint32_t* found);
extern decltype(find_in_rows_plain)& find_in_rows;

/// Point (x, ζ) in the plane of the rays of one t and one V: x as a column of hogels relative to the region's first
/// hogel, and the depth in hogels: the shift of x for U = 1.
struct SegmentPoint {
    double x = 0, depth = 0;
};

/// Part of a triangle visible to the rays of one t and one V, usually the segment between the points at which two edges
/// cross their plane. In the plane (s, U) each point is a line, and the segment is the band between two lines.
struct Band {
    std::array<SegmentPoint, 5> points;  ///< at most two crossings of edges and three vertices
    std::size_t count = 0;
    std::uint32_t triangle = 0;
    std::size_t row = 0;
    render::Span columns{};             ///< directions U with rays that may meet it
    std::array<double, 3> fast, depth;  ///< x and ζ of the triangle's corners, metres
    std::array<double, 3> slow;         ///< y − Vζ − t of the row

    void include(SegmentPoint p) { points[count++] = p; }
};

/// Rays of one V of a region, and the triangles that they may meet. All arguments must outlive this object.
class SlabRays {
  public:
    SlabRays(std::span<const SlabTriangle> triangles, bool fronts_only, const LightFieldGrid& grid,
             const HogelRange& range, std::size_t slow);

    const SlabTriangle& triangle(std::uint32_t index) const { return triangles_[index]; }
    bool fronts_only() const { return fronts_only_; }
    const render::RowAxes& axes() const { return axes_; }
    std::size_t rows() const { return rows_; }
    std::size_t hogels() const { return hogels_; }
    std::size_t directions() const { return directions_; }
    double slow_slope() const { return slow_slope_; }
    /// Returns dx/dζ along the fast axis of each direction, padded by a vector after the last.
    const double* slopes() const { return slopes_.data(); }
    /// Returns the same in hogels, positive in the direction of rising hogel indices.
    const double* steps() const { return steps_.data(); }
    /// Returns the intersection of a triangle with the ray of a hogel and direction of a row; the depth is infinite if
    /// there is none.
    render::VisiblePoint sees(std::uint32_t index, std::size_t row, std::size_t hogel, std::size_t direction) const {
        const double slow = slow_hogel(row), fast = fast_hogel(hogel), fast_slope = slopes_[direction];
        const auto& corners = triangles_[index].corners;
        if (axes_.transposed())
            return render::visible_point(index, render::ObliqueTriangle(corners, fronts_only_, slow_slope_, fast_slope),
                                         slow, fast);
        return render::visible_point(index, render::ObliqueTriangle(corners, fronts_only_, fast_slope, slow_slope_),
                                     fast, slow);
    }

    double slow_hogel(std::size_t row) const { return axes_.slow_hogel(range_, row); }
    double fast_hogel(std::size_t i) const { return axes_.fast_hogel(range_, i); }
    /// fast_hogel(i) equals (first_fast() + fast_sign() i) pitch() to the last bit, because all products but the last
    /// are exact.
    double first_fast() const { return first_fast_; }
    double fast_sign() const { return axes_.fast_sign(); }
    double pitch() const { return grid_.pitch; }

    /// Returns the index of a sample in the slab's words: [rows][hogels][directions].
    std::size_t word(std::size_t row, std::size_t hogel, std::size_t direction) const {
        return (row * hogels_ + hogel) * directions_ + direction;
    }

    /// Return dx/dζ or dy/dζ of the rays of one V along the slow axis, and along the fast axis.
    static double slow_slope_of(const LightFieldGrid& grid, const render::RowAxes& axes, std::size_t slow);
    static double fast_slope_of(const LightFieldGrid& grid, const render::RowAxes& axes, std::size_t slow,
                                std::size_t fast);

  private:
    static constexpr std::size_t padding = 64;

    std::span<const SlabTriangle> triangles_;
    bool fronts_only_;
    const LightFieldGrid& grid_;
    const HogelRange& range_;
    render::RowAxes axes_;
    std::size_t rows_, hogels_, directions_;
    double slow_slope_, first_fast_;
    std::vector<double> slopes_, steps_;
};

/// Packs a triangle seen by a sample into one word: order-preserving bits of the depth above the triangle's index. The
/// smallest word is the nearest triangle and, at equal depth, the one with the lowest index, for any order of drawing.
inline std::uint64_t seen_word(float depth, std::uint32_t triangle) {
    return std::uint64_t{render::ordered_bits(depth + 0.0f)} << 32 | triangle;  // −0 is 0
}
inline std::uint64_t nothing_seen() {
    return seen_word(std::numeric_limits<float>::infinity(), render::NearestTriangle::none);
}
inline std::uint32_t triangle_of(std::uint64_t word) { return static_cast<std::uint32_t>(word); }

/// Tests the ray of a hogel and direction of a band's row against its triangle.
void see_sample(const Band& band, const SlabRays& rays, std::size_t hogel, std::size_t direction, std::uint64_t* words);

/// Scan converts bands: tests the samples between the two lines of each, and counts them.
/// @param words  of all samples of the slab
void draw_bands_plain(std::span<const Band> bands, const SlabRays& rays, std::uint64_t* words, Visits& visits);
extern decltype(draw_bands_plain)& draw_bands;

}  // namespace hogel::simplex
