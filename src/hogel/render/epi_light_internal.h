#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hogel/render/epi_kernels_internal.h"
#include "hogel/shading/light_cache.h"

namespace hogel {

/// Where the samples of a strip have their light from.
struct alignas(64) StripLight {
    enum class From : std::uint32_t {
        ends,     ///< interpolated between the values of the strip's ends
        points,   ///< the light that is kept on its triangle is all of their radiance; the values of the ends have none
        samples,  ///< each is asked for
    };

    /// Rows and columns of the grid on the triangle (LightGrid): `towards` and `last` at end 0, and from there to
    /// end 1.
    float place[2] = {}, change[2] = {};
    float scale[2] = {}, last_cell[2] = {};  ///< of LightGrid::Axis
    const std::uint32_t* points = nullptr;   ///< null unless From::points
    std::uint32_t down = 0, right = 0;       ///< words from a point to the next, where there are several
    From from = From::ends;
};

/// @param weights0, weights1  of the triangle's vertices, at the strip's ends
inline StripLight light_of_points(const LightGrid& grid, const std::array<float, 3>& weights0,
                                  const std::array<float, 3>& weights1) {
    const LightGrid::Axis rows(grid.rows), columns(grid.columns);
    const float towards = grid.towards(weights0), last = grid.last(weights0);
    return {{towards, last},
            {grid.towards(weights1) - towards, grid.last(weights1) - last},
            {rows.scale, columns.scale},
            {rows.last, columns.last},
            grid.points,
            grid.rows > 0 ? grid.down : 0,
            grid.columns > 0 ? grid.right : 0,
            StripLight::From::points};
}

/// What is worked out for single samples and points while a plane is shaded.
class SampleSource {
  public:
    virtual ~SampleSource() = default;
    /// The radiance of sample (column, k) of the plane, `part` of the way along a strip From::samples.
    virtual Rgb radiance(std::size_t strip, float part, std::size_t column, std::size_t k) const = 0;
    /// The light of four points that are not made yet (LightCache::corners).
    virtual LightCache::Corners corners(std::size_t strip, std::size_t row, std::size_t column) const = 0;
};

/// As `shade` (epi_kernels_internal.h), for strips that do not all have their light from their ends: `lights` has one
/// for each. Twins that give the same bits.
void shade_lit_plain(const EpipolarPlane& plane, std::span<const StripShades> strips,
                     std::span<const StripLight> lights, const SampleSource& samples, const ShadedPlane& out);
void shade_lit(const EpipolarPlane& plane, std::span<const StripShades> strips, std::span<const StripLight> lights,
               const SampleSource& samples, const ShadedPlane& out);

}  // namespace hogel
