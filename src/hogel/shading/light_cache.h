#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "hogel/shading/shaded_scene.h"

namespace hogel {

/// The light on the surfaces of a scene, worked out at points of a grid on each triangle the first time that a ray
/// needs them, and interpolated for all other rays. Several threads may read at once. What is read is a function of
/// triangle and weights alone, whoever asked before: threads that meet at a point work out the same numbers.
///
/// The grid of a triangle runs in rows along its shortest side, the narrower the nearer to the corner opposite; so it
/// suits slivers and lies within the triangle. Interpolation, and beyond the outermost points extrapolation, is exact
/// for what is linear.
class LightCache {
  public:
    /// @param spacing  of each triangle: metres between the points of its grid, at most; 0 where it is to have none
    /// @param most_bytes  of all points. Triangles whose grids no longer fit, in the scene's order, have none
    LightCache(const ShadedScene& scene, std::span<const float> spacing, double most_bytes);

    /// The light on the point of triangle `index` with these weights, as SampleLighting::light_on gives it. False, and
    /// nothing read, for a triangle without a grid.
    bool read(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
              std::span<float> light) const;

    /// What the cache takes when all points of its grids have been used.
    double bytes() const { return static_cast<double>(words_) * sizeof(std::uint32_t); }
    /// Triangles whose light is worked out for each ray for want of room.
    std::size_t triangles_without_room() const { return without_room_; }
    /// How many points have been worked out so far; the same point twice where threads met.
    std::size_t points_made() const { return points_made_; }

  private:
    // The points of a triangle, row after row from the corner on.
    struct Grid {
        std::uint64_t first = 0;              // word of the first point
        std::uint32_t rows = 0, columns = 0;  // of cells; no rows: no grid
        std::uint32_t corner = 0;             // 0, 1 or 2
    };
    static std::size_t words_of(SampleLighting::Size size);

    // A point is a word that says whether the others hold, numbers of any size a word each, and shares four a word.
    const std::uint32_t* point(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                               SampleLighting::Size size) const;
    void make_point(const ShadedScene& scene, std::size_t index, std::size_t row, std::size_t column,
                    SampleLighting::Size size, std::uint32_t* words) const;

    struct Free {
        void operator()(std::uint32_t* words) const { std::free(words); }
    };

    std::vector<Grid> grids_;
    std::unique_ptr<std::uint32_t, Free> points_;  // zero at first, and untouched pages take no memory
    std::uint64_t words_ = 0;
    std::size_t without_room_ = 0;
    mutable std::atomic<std::size_t> points_made_ = 0;
};

/// Gives a scene whose light is worked out for each sample a cache of it; other scenes stay as they are.
void cache_light(ShadedScene& scene, std::span<const float> spacing, double most_bytes = 1e9);

}  // namespace hogel
