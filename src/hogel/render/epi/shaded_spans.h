// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/setup.h"
#include "hogel/shading/radiance_cache.h"

namespace hogel::render::epi {

/// The source of the radiance of a span's samples.
enum class RadianceFrom : std::uint32_t {
    ends,     ///< interpolated between the values at the span's ends
    cache,    ///< interpolated between knots from the radiance cache; the values at the ends have only depth
    samples,  ///< evaluated for each sample (RadianceSource::radiance)
};

/// The path of a span RadianceFrom::cache across the grid of cached points on its triangle (LightGrid).
struct SpanOnGrid {
    /// The coordinates LightGrid::towards (for rows) and LightGrid::last (for columns): at end 0, and the change to end
    /// 1.
    float start[2], change[2];
    shading::LightGrid::Axis axis[2];
    const std::uint32_t* points;
    std::uint32_t down, right;  ///< words from a point to the next one; 0 if there is only one

    SpanOnGrid(const shading::LightGrid& grid, const SpanOrigin& span);
    /// The number of intervals between the span's knots: each is at most half as long as a cell of the grid, unless
    /// that would take more than `max_intervals`.
    float intervals() const;
    static constexpr float max_intervals = 1 << 16, per_cell = 2;
};

/// Gives the shading of a plane the radiance of spans that is not interpolated between their ends.
class RadianceSource {
  public:
    virtual ~RadianceSource() = default;
    /// The radiance of sample (column, k) of the plane, at a position from 0 to 1 on a span RadianceFrom::samples.
    virtual Rgb radiance(std::size_t span, float position, std::size_t column, std::size_t k) const = 0;
    /// The positions of spans RadianceFrom::cache: their origins on triangles by number of span, and the grids by
    /// triangle.
    struct Grids {
        const SpanOrigin* of_spans;
        const shading::LightGrid* of_triangles;
    };
    virtual Grids grids() const = 0;
    /// Fills and returns four points of the radiance cache of which some are not filled yet (RadianceCache::corners).
    virtual shading::RadianceCache::Corners corners(std::size_t span, std::size_t row, std::size_t column) const = 0;
};

/// The spans of one plane, if not all interpolate radiance between their ends. Each has equidistant knots, and values
/// are linear between two knots. The knots of spans RadianceFrom::cache are filled from the cache once the visible
/// spans are known; there are far fewer knots than samples.
class ShadedSpans {
  public:
    /// R, G, B (or the only channel first), depth ζ in metres: NaN while the knot is pending.
    using Knot = std::array<float, 4>;
    /// The data of a span that a sample needs, in half a cache line.
    struct alignas(32) Span {
        float x0, z0, dx, dz;    ///< of SpanValues
        std::uint32_t base;      ///< number of the first knot minus the bits of LightGrid::to_whole
        float intervals, limit;  ///< number of intervals between the knots; `last` of LightGrid::Axis
        RadianceFrom from;

        /// @param first_knot  `pending_knots` if the span has none yet
        void set_knots(std::uint32_t first_knot, float count) {
            base = first_knot - std::bit_cast<std::uint32_t>(shading::LightGrid::to_whole);
            intervals = count;
            limit = count - 1.25f;
        }
        std::uint32_t first_knot() const { return base + std::bit_cast<std::uint32_t>(shading::LightGrid::to_whole); }
    };
    /// The interval of a span that contains a position from 0 to 1, and the fraction within the interval.
    struct Interval {
        std::uint32_t index;
        float fraction;

        Interval(const Span& span, float position) {
            const float at = position * span.intervals;
            const float rounded = std::min(at - 0.5f, span.limit) + shading::LightGrid::to_whole;
            index = std::bit_cast<std::uint32_t>(rounded) & shading::LightGrid::node_bits;
            fraction = at - (rounded - shading::LightGrid::to_whole);
        }
    };
    /// The first of two knots that always stay pending, shared by all spans without other knots.
    static constexpr std::uint32_t pending_knots = 0;

    /// Removes all spans except number 0, the background. The background's depth is not stored, because it may be
    /// infinite.
    void clear(const SpanValues& background);
    /// Appends a span RadianceFrom::ends.
    void add_between_ends(const SpanValues& span);
    /// Appends another span.
    void add(const SpanValues& span, RadianceFrom from);

    const Span* spans() const { return spans_.data(); }
    const Knot* knots() const { return knots_.data(); }
    Knot* knots() { return knots_.data(); }
    /// Gives span `number`, RadianceFrom::cache, knots of undefined value, and returns the number of the first.
    std::uint32_t add_knots(std::size_t number, float intervals);
    /// As add_knots(), with pending knots.
    void add_pending_knots(std::size_t number, float intervals);

    /// Whether there are spans RadianceFrom::cache.
    bool has_cached() const { return has_cached_; }
    /// For each span 1 if it is RadianceFrom::cache and has no knots yet, otherwise 0.
    std::uint8_t* pending() { return pending_.data(); }

  private:
    void add_span(const SpanValues& span, RadianceFrom from, std::uint32_t first_knot);
    std::uint32_t take_knots(std::size_t count);

    std::vector<Span, CacheLineAllocator<Span>> spans_;
    std::vector<Knot, CacheLineAllocator<Knot>> knots_;  // the first `used_` are in use
    std::size_t used_ = 0;
    std::vector<std::uint8_t> pending_;
    bool has_cached_ = false;
};

/// Gives knots to all pending spans in these words. Knots are filled if the cache has all their points; others, and
/// those of spans with very many knots, of which few may be visible, stay pending until a sample needs them.
extern void (&fill_visible_knots)(std::span<const std::uint64_t> words, std::span<const SpanValues> values,
                                  ShadedSpans& spans, const RadianceSource& source, bool colour);

/// Fills the two knots around a position on span `number`, RadianceFrom::cache, if they are pending.
void fill_knots_around(float position, std::size_t number, const SpanValues& values, ShadedSpans& spans,
                       const RadianceSource& source, bool colour);

/// As shade_between_ends(), with values interpolated between knots. The twins give the same bits.
/// @param spans  as many as `values`
void shade_between_knots_plain(const EpipolarPlane& plane, std::span<const SpanValues> values, ShadedSpans& spans,
                               const RadianceSource& source, const PlaneOutput& out);
extern decltype(shade_between_knots_plain)& shade_between_knots;

}  // namespace hogel::render::epi
