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

enum class RadianceFrom : std::uint32_t {
    ends,     ///< interpolated between the values at the span's ends
    cache,    ///< interpolated between knots from the radiance cache; the values at the ends have only depth
    samples,  ///< evaluated for each sample (RadianceSource::radiance)
};

/// Path of a span with RadianceFrom::cache across the grid of cached points on its triangle (LightGrid).
struct SpanOnGrid {
    /// Coordinates LightGrid::towards (for rows) and LightGrid::last (for columns) at end 0, and their change to end 1.
    float start[2], change[2];
    shading::LightGrid::Axis axis[2];
    const std::uint32_t* points;
    std::uint32_t down, right;  ///< words from a point to the next one; 0 if there is only one

    SpanOnGrid(const shading::LightGrid& grid, const SpanOrigin& span);
    /// Returns the number of intervals between the span's knots. Each interval is at most half a cell of the grid long,
    /// unless that would need more than `max_intervals`.
    float intervals() const;
    static constexpr float max_intervals = 1 << 16, per_cell = 2;
};

/// Source of the radiance of spans that is not interpolated between their ends.
class RadianceSource {
  public:
    virtual ~RadianceSource() = default;
    /// Returns the radiance of sample (column, k) at a position (0 to 1) on a span with RadianceFrom::samples.
    virtual Rgb radiance(std::size_t span, float position, std::size_t column, std::size_t k) const = 0;
    /// Origins of spans on triangles by number of span, and grids by triangle, for spans with RadianceFrom::cache.
    struct Grids {
        const SpanOrigin* of_spans;
        const shading::LightGrid* of_triangles;
    };
    virtual Grids grids() const = 0;
    /// Returns four points of the radiance cache (RadianceCache::corners) after filling the missing ones.
    virtual shading::RadianceCache::Corners corners(std::size_t span, std::size_t row, std::size_t column) const = 0;
};

/// Spans of one plane, if not all interpolate radiance between their ends. Each has equidistant knots, and values are
/// linear between two knots. Once the visible spans are known, the knots of those with RadianceFrom::cache are filled
/// from the cache. There are far fewer knots than samples.
class ShadedSpans {
  public:
    /// R, G, B (or the only channel first), depth ζ in metres: NaN while the knot is pending.
    using Knot = std::array<float, 4>;
    /// Span data for shading a sample, in half a cache line.
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
    /// Interval of a span that contains a position from 0 to 1, and the fraction within the interval.
    struct Interval {
        std::uint32_t index;
        float fraction;

        Interval(const Span& span, float position) {
            const float scaled = position * span.intervals;
            const float rounded = std::min(scaled - 0.5f, span.limit) + shading::LightGrid::to_whole;
            index = std::bit_cast<std::uint32_t>(rounded) & shading::LightGrid::node_bits;
            fraction = scaled - (rounded - shading::LightGrid::to_whole);
        }
    };
    /// First of two knots that always stay pending, shared by all spans without other knots.
    static constexpr std::uint32_t pending_knots = 0;

    /// Removes all spans except number 0, the background. The background's depth may be infinite and is not stored.
    void clear(const SpanValues& background);
    /// Appends a span with RadianceFrom::ends.
    void add_between_ends(const SpanValues& span);
    /// Appends another span.
    void add(const SpanValues& span, RadianceFrom from);

    const Span* spans() const { return spans_.data(); }
    const Knot* knots() const { return knots_.data(); }
    Knot* knots() { return knots_.data(); }
    /// Adds knots of undefined value to span `number` with RadianceFrom::cache, and returns the number of the first.
    std::uint32_t add_knots(std::size_t number, float intervals);
    /// Adds pending knots to a span; otherwise as add_knots().
    void add_pending_knots(std::size_t number, float intervals);

    /// Returns whether there are spans with RadianceFrom::cache.
    bool has_cached() const { return has_cached_; }
    /// Returns for each span 1 if it has RadianceFrom::cache and no knots yet, otherwise 0.
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

/// Adds knots to all pending spans in these words. Fills the knots if the cache has all their points. Otherwise, and
/// for spans with very many knots, they stay pending until a sample needs them.
extern void (&fill_visible_knots)(std::span<const std::uint64_t> words, std::span<const SpanValues> values,
                                  ShadedSpans& spans, const RadianceSource& source, bool colour);

/// Fills the two knots around a position on span `number` with RadianceFrom::cache, if they are pending.
void fill_knots_around(float position, std::size_t number, const SpanValues& values, ShadedSpans& spans,
                       const RadianceSource& source, bool colour);

/// Shades as shade_between_ends(), with values interpolated between knots. Both versions give the same bits.
/// @param spans  of the same length as `values`
void shade_between_knots_plain(const EpipolarPlane& plane, std::span<const SpanValues> values, ShadedSpans& spans,
                               const RadianceSource& source, const PlaneOutput& out);
extern decltype(shade_between_knots_plain)& shade_between_knots;

}  // namespace hogel::render::epi
