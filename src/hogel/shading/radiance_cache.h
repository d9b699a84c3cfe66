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

/// The grid of cached points on a triangle. Rows of points are parallel to its shortest side and become narrower
/// towards the opposite corner, where the first row is. So slivers need few points, and all points are inside the
/// triangle. A single row or column is in the middle.
struct alignas(32) LightGrid {
    /// Distance of the outermost points from the triangle's corners and sides, in cells. Other surfaces often touch the
    /// triangle at an edge, and their contact shadows would not represent the area around a point there. The four
    /// points of a small triangle are close to those of a Gauss quadrature.
    static constexpr float inset = 0.25f;

    const std::uint32_t* points = nullptr;  ///< row by row, less than 2³¹ words; null: the triangle has no grid
    std::uint32_t rows = 0, columns = 0;    ///< number of cells between points
    std::uint32_t down = 0, right = 0;      ///< words from a point to the next one in its column, and in its row
    std::uint32_t corner = 0;               ///< opposite the shortest side: 0, 1 or 2
    bool is_radiance = false;               ///< see SampleLighting::light_is_radiance

    /// The scale of one axis, rows or columns.
    struct Axis {
        /// `scale`: factor from a fraction of the side, 0 to 1, to point numbers. `last`: upper limit of a point number
        /// minus a half, so that it rounds at most to the last cell.
        float scale, last;

        Axis(float scale_, float last_) : scale(scale_), last(last_) {}
        explicit Axis(std::uint32_t cells)
            : scale(static_cast<float>(std::max(cells, 1u)) + 2 * inset),
              last(static_cast<float>(std::max(cells, 1u)) - 1.25f) {}
    };
    /// A fraction of a side, 0 to 1, as a cell and a position within it.
    struct Place {
        std::uint32_t node;  ///< number of the cell's first point
        float beyond;        ///< position relative to that point, in cells: −inset to 1 + inset

        Place(float part, const Axis& axis) {
            const float at = std::min(std::max(part, 0.0f), 1.0f) * axis.scale - (inset + 0.5f);
            const float rounded = std::min(std::max(at, -0.25f), axis.last) + to_whole;
            node = std::bit_cast<std::uint32_t>(rounded) & node_bits;
            beyond = (at - (rounded - to_whole)) + 0.5f;
        }
    };
    /// Added to a float, this rounds it to a whole number, which is then in the last bits of the sum (node_bits).
    static constexpr float to_whole = 0x1.8p23f;
    static constexpr std::uint32_t node_bits = 0x3fffff;

    /// Two coordinates from the weights of the triangle's vertices: towards() is that from the corner (0) to the
    /// opposite side (1), last() the weight of the last vertex at that side.
    float towards(const std::array<float, 3>& weights) const { return 1 - weights[corner]; }
    float last(const std::array<float, 3>& weights) const { return weights[(corner + 2) % 3]; }
    /// The coordinate along the row, computed from those.
    static float along(float towards, float last) { return last / std::max(towards, 1e-30f); }

    /// The words of a point are its first three numbers, its state, and the other numbers. This is the state of a point
    /// that may be read:
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

/// The light on the surfaces of a scene, computed at points of a grid on each triangle when a ray first needs them, and
/// interpolated for all other rays. Several threads may read at once. Values depend only on triangle and weights, not
/// on earlier reads; threads that fill a point at the same time compute the same numbers.
///
/// Interpolation, and extrapolation beyond the outermost points, is exact for light that is linear over the triangle,
/// except across a side not longer than the spacing, where a single point in the middle represents the whole width.
class RadianceCache {
  public:
    /// @param spacing    for each triangle, the largest distance of its points, metres; 0: no grid
    /// @param max_bytes  limit for all points. Triangles, in the scene's order, whose grids do not fit have none
    RadianceCache(const ShadedScene& scene, std::span<const float> spacing, double max_bytes);

    /// Reads the light on the point of triangle `index` with these weights, as SampleLighting::light_on() gives it.
    /// Returns false and reads nothing for a triangle without a grid.
    bool read(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
              std::span<float> light) const;

    /// The grid of a triangle, for loops that read points directly.
    const LightGrid& grid(std::size_t index) const { return grids_[index]; }
    std::span<const LightGrid> grids() const { return grids_; }
    /// The first three numbers of four points, which are filled if necessary, each followed by a zero: a point of
    /// triangle `index`, the next one in its row, and the two in the next row.
    using Corners = std::array<std::array<float, 4>, 4>;
    Corners corners(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column) const;

    /// The size of the cache when all points of its grids have been used.
    double bytes() const { return static_cast<double>(words_) * sizeof(std::uint32_t); }
    /// Number of triangles whose grids did not fit, so that their light is evaluated for each ray.
    std::size_t uncached_triangles() const { return uncached_triangles_; }
    /// Number of points computed so far; points filled by several threads count more than once.
    std::size_t points_filled() const { return points_filled_; }

  private:
    using FourPoints = std::array<const std::uint32_t*, 4>;

    // The words of those four points: in the grid or, for a point that another thread is filling, in `scratch`.
    FourPoints four_points(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                           std::vector<std::uint32_t>& scratch) const;
    void compute_point(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                       std::uint32_t* words) const;

    struct Free {
        void operator()(std::uint32_t* words) const { std::free(words); }
    };

    std::vector<LightGrid> grids_;
    std::unique_ptr<std::uint32_t, Free> points_;  // from calloc: zero at first, and untouched pages take no memory
    std::uint64_t words_ = 0;
    std::size_t uncached_triangles_ = 0;
    mutable std::atomic<std::size_t> points_filled_ = 0;
};

/// Gives a scene with `lighting` a radiance cache; other scenes are unchanged. Parameters as for RadianceCache.
void add_radiance_cache(ShadedScene& scene, std::span<const float> spacing, double max_bytes = 1e9);

}  // namespace hogel::shading
