// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "hogel/shading.h"

namespace hogel::shading {

/// Grid of cached points on a triangle. Rows of points are parallel to its shortest side and become narrower towards
/// the opposite corner, where the first row is. So slivers need few points, and all points are inside the triangle. A
/// single row or column is in the middle.
struct alignas(32) LightGrid {
    /// Distance of the outermost points from the triangle's corners and sides, in cells. Other surfaces often touch the
    /// triangle at an edge; a point at their contact shadow would not represent its surroundings. The four points of a
    /// small triangle are close to those of a Gauss quadrature.
    static constexpr float inset = 0.25f;

    const std::uint32_t* points = nullptr;  ///< row-major, less than 2³¹ words; null if there is no grid
    std::uint32_t rows = 0, columns = 0;    ///< number of cells between points
    std::uint32_t down = 0, right = 0;      ///< strides in words between the points of a column and of a row
    std::uint32_t corner = 0;               ///< opposite the shortest side: 0, 1 or 2
    bool is_radiance = false;               ///< SampleLighting::light_is_radiance

    struct Axis {
        /// `scale`: factor from a fraction of the side, 0 to 1, to point indices. `last`: upper limit of a point index
        /// minus a half, so that it rounds at most to the last cell.
        float scale, last;

        Axis(float scale_, float last_) : scale(scale_), last(last_) {}
        explicit Axis(std::uint32_t cells)
            : scale(static_cast<float>(std::max(cells, 1u)) + 2 * inset),
              last(static_cast<float>(std::max(cells, 1u)) - 1.25f) {}
    };
    /// Cell that contains a fraction of a side, 0 to 1, and the position within the cell.
    struct Cell {
        std::uint32_t node;  ///< index of the cell's first point
        float fraction;      ///< position relative to this point, in cells: −inset to 1 + inset

        Cell(float side_fraction, const Axis& axis) {
            const float position = std::min(std::max(side_fraction, 0.0f), 1.0f) * axis.scale - (inset + 0.5f);
            const float rounded = std::min(std::max(position, -0.25f), axis.last) + to_whole;
            node = std::bit_cast<std::uint32_t>(rounded) & node_bits;
            fraction = (position - (rounded - to_whole)) + 0.5f;
        }
    };
    /// Added to a float, this rounds it to an integer in the low bits of the sum (node_bits).
    static constexpr float to_whole = 0x1.8p23f;
    static constexpr std::uint32_t node_bits = 0x3fffff;

    /// Return two coordinates from the weights of the triangle's vertices. towards() is the coordinate from the corner
    /// (0) to the opposite side (1). last() is the weight of the last vertex on this side.
    float towards(const std::array<float, 3>& weights) const { return 1 - weights[corner]; }
    float last(const std::array<float, 3>& weights) const { return weights[(corner + 2) % 3]; }
    /// Returns the coordinate along the row, computed from these two.
    static float along(float towards, float last) { return last / std::max(towards, 1e-30f); }

    /// State of a readable point. The words of a point are three values, its state, and the other values.
    static constexpr std::uint32_t filled = 0x80000000;
    static bool is_filled(const std::uint32_t* point) { return (state(point) & filled) != 0; }
    static bool are_filled(const std::uint32_t* a, const std::uint32_t* b, const std::uint32_t* c,
                           const std::uint32_t* d) {
        return (state(a) & state(b) & state(c) & state(d) & filled) != 0;
    }

  private:
    static std::uint32_t state(const std::uint32_t* point) {
        return std::atomic_ref(const_cast<std::uint32_t&>(point[3])).load(std::memory_order_acquire);
    }
};

/// Light on the surfaces of a scene, computed at points of a grid on each triangle at the first use, and interpolated
/// for all other rays. Several threads may read at once. Values depend only on triangle and weights, not on earlier
/// reads; threads that fill a point at the same time compute the same values.
///
/// Interpolation, and extrapolation beyond the outermost points, is exact for light that is linear over the triangle,
/// except across a side not longer than the spacing, where a single point in the middle represents the whole width.
class RadianceCache {
  public:
    /// @param spacing    for each triangle, the largest distance of its points in metres; 0: no grid
    /// @param max_bytes  limit for all points. Triangles, in the scene's order, with grids beyond the limit get no grid
    RadianceCache(const ShadedScene& scene, std::span<const float> spacing, double max_bytes);

    /// Reads the light at the point of triangle `index` with these weights, in the layout of
    /// SampleLighting::light_on(). Returns false and reads nothing for a triangle without a grid.
    bool read(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
              std::span<float> light) const;

    /// Returns the grid of a triangle, for loops that read points directly.
    const LightGrid& grid(std::size_t index) const { return grids_[index]; }
    std::span<const LightGrid> grids() const { return grids_; }
    /// Returns R, G, B and a zero for four grid points of triangle `index`: [0] at (row, column), [1] at (row, column +
    /// 1), [2] at (row + 1, column), [3] at (row + 1, column + 1). Indices beyond the grid are replaced by the last
    /// ones. Computes points that are not filled.
    using Corners = std::array<std::array<float, 4>, 4>;
    Corners corners(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column) const;

    /// Returns the size of the cache in bytes when all points of its grids are in use.
    double bytes() const { return static_cast<double>(words_) * sizeof(std::uint32_t); }
    /// Returns the number of triangles without a grid for lack of memory; their light is evaluated for each ray.
    std::size_t uncached_triangles() const { return uncached_triangles_; }
    /// Returns the number of points computed so far; points filled by several threads count more than once.
    std::size_t points_filled() const { return points_filled_; }

  private:
    using FourPoints = std::array<const std::uint32_t*, 4>;

    // Returns pointers to these four points: in the grid or, if another thread is filling a point, in `scratch`.
    FourPoints four_points(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                           std::vector<std::uint32_t>& scratch) const;
    void compute_point(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                       std::uint32_t* words) const;

    struct Free {
        void operator()(std::uint32_t* words) const { std::free(words); }
    };

    std::vector<LightGrid> grids_;
    std::unique_ptr<std::uint32_t, Free> points_;  // from calloc: zeroed, and untouched pages take no memory
    std::uint64_t words_ = 0;
    std::size_t uncached_triangles_ = 0;
    mutable std::atomic<std::size_t> points_filled_ = 0;
};

/// Adds a radiance cache to a scene with `lighting`; other scenes are unchanged. Parameters as for RadianceCache.
void add_radiance_cache(ShadedScene& scene, std::span<const float> spacing, double max_bytes = 1e9);

}  // namespace hogel::shading
