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

/// Where the light of a triangle is kept: at points in rows along its shortest side, from the corner opposite on, the
/// rows narrower the nearer to that corner; so it suits slivers and lies within the triangle. A row or a column of
/// points alone runs through the middle.
struct alignas(32) LightGrid {
    /// The outermost points lie this part of a cell within the triangle: just at its corners and sides it touches
    /// others, and shadows of what touches say little about what is around. Four points on a small triangle are about
    /// where Gauss puts them.
    static constexpr float inset = 0.25f;

    const std::uint32_t* points = nullptr;  ///< row after row, less than 2³¹ words; null: the triangle has no grid
    std::uint32_t rows = 0, columns = 0;    ///< of cells between points
    std::uint32_t down = 0, right = 0;      ///< words from a point to the next in its column, and in its row
    std::uint32_t corner = 0;               ///< 0, 1 or 2
    bool is_radiance = false;               ///< see SampleLighting::light_is_radiance

    /// Along rows or along columns: the number of the first point of the cell in which a part from 0 to 1 lies, and how
    /// far it is on from there, in cells: from −inset on the first stretch to 1 + inset on the last.
    struct Axis {
        /// From the part to numbers of points less a half; and what such a number is held below, to round to the last
        /// cell.
        float scale, last;

        Axis(float scale_, float last_) : scale(scale_), last(last_) {}
        explicit Axis(std::uint32_t cells)
            : scale(static_cast<float>(std::max(cells, 1u)) + 2 * inset),
              last(static_cast<float>(std::max(cells, 1u)) - 1.25f) {}
    };
    struct Place {
        std::uint32_t node;
        float beyond;

        Place(float part, const Axis& axis) {
            const float at = std::min(std::max(part, 0.0f), 1.0f) * axis.scale - (inset + 0.5f);
            const float rounded = std::min(std::max(at, -0.25f), axis.last) + to_whole;
            node = std::bit_cast<std::uint32_t>(rounded) & node_bits;
            beyond = (at - (rounded - to_whole)) + 0.5f;
        }
    };
    /// Floats from here on are whole numbers, which their last bits tell; so adding it rounds.
    static constexpr float to_whole = 0x1.8p23f;
    static constexpr std::uint32_t node_bits = 0x3fffff;

    /// How far from the corner towards the side opposite a point of the triangle lies, from the weights of its
    /// vertices; and the weight of the last of the two at that side.
    float towards(const std::array<float, 3>& weights) const { return 1 - weights[corner]; }
    float last(const std::array<float, 3>& weights) const { return weights[(corner + 2) % 3]; }
    /// How far along the row, from those.
    static float along(float towards, float last) { return last / std::max(towards, 1e-30f); }

    /// Whether the words of a point hold: then they are the first three numbers, this one, and all others.
    static constexpr std::uint32_t made = 0x80000000;
    static bool is_made(const std::uint32_t* point) { return (state(point) & made) != 0; }
    static bool are_made(const std::uint32_t* a, const std::uint32_t* b, const std::uint32_t* c,
                         const std::uint32_t* d) {
        return (state(a) & state(b) & state(c) & state(d) & made) != 0;
    }

  private:
    static std::uint32_t state(const std::uint32_t* point) {
        return std::atomic_ref(const_cast<std::uint32_t&>(point[3])).load(std::memory_order_acquire);
    }
};

/// The light on the surfaces of a scene, worked out at points of a grid on each triangle the first time that a ray
/// needs them, and interpolated for all other rays. Several threads may read at once. What is read is a function of
/// triangle and weights alone, whoever asked before: threads that meet at a point work out the same numbers.
///
/// Interpolation, and beyond the outermost points extrapolation, is exact for what is linear, but across what is no
/// wider than the spacing, where a single point in the middle stands for all.
class LightCache {
  public:
    /// @param spacing  of each triangle: metres between the points of its grid, at most; 0 where it is to have none
    /// @param max_bytes  of all points. Triangles whose grids no longer fit, in the scene's order, have none
    LightCache(const ShadedScene& scene, std::span<const float> spacing, double max_bytes);

    /// The light on the point of triangle `index` with these weights, as SampleLighting::light_on gives it. False, and
    /// nothing read, for a triangle without a grid.
    bool read(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
              std::span<float> light) const;

    /// For loops that read by themselves.
    const LightGrid& grid(std::size_t index) const { return grids_[index]; }
    std::span<const LightGrid> grids() const { return grids_; }
    /// The first three numbers of four points, made if need be: of a point of triangle `index`, the next in its row,
    /// and the two in the next row; each followed by a zero.
    using Corners = std::array<std::array<float, 4>, 4>;
    Corners corners(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column) const;

    /// What the cache takes when all points of its grids have been used.
    double bytes() const { return static_cast<double>(words_) * sizeof(std::uint32_t); }
    /// Triangles whose light is worked out for each ray for want of room.
    std::size_t triangles_without_room() const { return without_room_; }
    /// How many points have been worked out so far; the same point twice where threads met.
    std::size_t points_made() const { return points_made_; }

  private:
    using FourPoints = std::array<const std::uint32_t*, 4>;

    // Where the words of those four points are: in the grid, or where somebody else is making one, in `room`.
    FourPoints four_points(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                           std::vector<std::uint32_t>& room) const;
    void make_point(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                    std::uint32_t* words) const;

    struct Free {
        void operator()(std::uint32_t* words) const { std::free(words); }
    };

    std::vector<LightGrid> grids_;
    std::unique_ptr<std::uint32_t, Free> points_;  // zero at first, and untouched pages take no memory
    std::uint64_t words_ = 0;
    std::size_t without_room_ = 0;
    mutable std::atomic<std::size_t> points_made_ = 0;
};

/// Gives a scene whose light is worked out for each sample a cache of it; other scenes stay as they are.
void cache_light(ShadedScene& scene, std::span<const float> spacing, double max_bytes = 1e9);

}  // namespace hogel::shading
