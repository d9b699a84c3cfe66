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

/// Where the samples of a span get their radiance from.
enum class RadianceFrom : std::uint32_t {
    ends,     ///< interpolated between the values at the span's ends
    cache,    ///< interpolated between knots from the radiance cache; the values at the ends hold depth alone
    samples,  ///< evaluated for each sample (RadianceSource::radiance)
};

/// How a span RadianceFrom::cache crosses the grid of cached points on its triangle (LightGrid).
struct SpanOnGrid {
    /// LightGrid::towards (for rows) and LightGrid::last (for columns): at end 0, and the change from there to end 1.
    float start[2], change[2];
    shading::LightGrid::Axis axis[2];
    const std::uint32_t* points;
    std::uint32_t down, right;  ///< words from a point to the next; 0 where there is only one

    SpanOnGrid(const shading::LightGrid& grid, const SpanOrigin& span);
    /// The number of intervals between the span's knots: each is at most half as long as a cell of the grid, as long as
    /// that takes no more than `max_intervals`.
    float intervals() const;
    static constexpr float max_intervals = 1 << 16, per_cell = 2;
};

/// What the shading of a plane asks for spans whose radiance is not interpolated between their ends.
class RadianceSource {
  public:
    virtual ~RadianceSource() = default;
    /// The radiance of sample (column, k) of the plane, at a position from 0 to 1 on a span RadianceFrom::samples.
    virtual Rgb radiance(std::size_t span, float position, std::size_t column, std::size_t k) const = 0;
    /// Where spans RadianceFrom::cache lie: on triangles by number of span, and those triangles' grids by triangle.
    struct Grids {
        const SpanOrigin* of_spans;
        const shading::LightGrid* of_triangles;
    };
    virtual Grids grids() const = 0;
    /// Four points of the radiance cache, of which some are not filled yet (RadianceCache::corners).
    virtual shading::RadianceCache::Corners corners(std::size_t span, std::size_t row, std::size_t column) const = 0;
};

/// The spans of one plane where not all take their radiance from their ends. Each has knots at equal distances along
/// it, and between two knots all values are linear. The knots of spans RadianceFrom::cache are filled from the cache
/// once it is known which spans are visible; there are far fewer knots than samples.
class ShadedSpans {
  public:
    /// R, G, B (or the only channel first), depth ζ in metres: NaN while the knot is pending.
    using Knot = std::array<float, 4>;
    /// All that a sample asks of its span, in half a cache line.
    struct alignas(32) Span {
        float x0, z0, dx, dz;    ///< of SpanValues
        std::uint32_t base;      ///< number of the first knot minus the bits of LightGrid::to_whole
        float intervals, limit;  ///< between the knots; `last` of LightGrid::Axis
        RadianceFrom from;

        /// @param first_knot  `pending_knots` if the span has none yet
        void set_knots(std::uint32_t first_knot, float count) {
            base = first_knot - std::bit_cast<std::uint32_t>(shading::LightGrid::to_whole);
            intervals = count;
            limit = count - 1.25f;
        }
        std::uint32_t first_knot() const { return base + std::bit_cast<std::uint32_t>(shading::LightGrid::to_whole); }
    };
    /// The interval of a span that holds a position from 0 to 1, and how far into it that is, as a fraction.
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
    /// First of two knots that always stay pending, shared by the spans that have no others.
    static constexpr std::uint32_t pending_knots = 0;

    /// Forgets all spans but number 0, the background. Its depth is left out here, because it may be infinite.
    void clear(const SpanValues& background);
    /// Appends a span RadianceFrom::ends.
    void add_between_ends(const SpanValues& span);
    /// Appends another span.
    void add(const SpanValues& span, RadianceFrom from);

    const Span* spans() const { return spans_.data(); }
    const Knot* knots() const { return knots_.data(); }
    Knot* knots() { return knots_.data(); }
    /// Gives span `number`, RadianceFrom::cache, knots of any value, and returns the number of the first.
    std::uint32_t add_knots(std::size_t number, float intervals);
    /// The same with pending knots.
    void add_pending_knots(std::size_t number, float intervals);

    /// Whether there are spans RadianceFrom::cache.
    bool has_cached() const { return has_cached_; }
    /// For each span 1 if it takes its radiance from the cache and has no knots yet, else 0.
    std::uint8_t* pending() { return pending_.data(); }

  private:
    void add_span(const SpanValues& span, RadianceFrom from, std::uint32_t first_knot);
    std::uint32_t take_knots(std::size_t count);

    std::vector<Span, CacheLineAllocator<Span>> spans_;
    std::vector<Knot, CacheLineAllocator<Knot>> knots_;  // of which `used_` are in use
    std::size_t used_ = 0;
    std::vector<std::uint8_t> pending_;
    bool has_cached_ = false;
};

/// Gives knots to all pending spans that these words show. They are filled where the cache has all points for them;
/// other knots, and those of spans with very many knots, of which few may be seen, stay pending until a sample needs
/// them.
void fill_visible_knots(std::span<const std::uint64_t> words, std::span<const SpanValues> values, ShadedSpans& spans,
                        const RadianceSource& source, bool colour);

/// Fills those of the two knots around a position on span `number`, RadianceFrom::cache, that are pending.
void fill_knots_around(float position, std::size_t number, const SpanValues& values, ShadedSpans& spans,
                       const RadianceSource& source, bool colour);

/// Like shade_between_ends(), with values interpolated between knots. The twins give the same bits.
/// @param spans  as many as `values`
void shade_between_knots_plain(const EpipolarPlane& plane, std::span<const SpanValues> values, ShadedSpans& spans,
                               const RadianceSource& source, const PlaneOutput& out);
void shade_between_knots(const EpipolarPlane& plane, std::span<const SpanValues> values, ShadedSpans& spans,
                         const RadianceSource& source, const PlaneOutput& out);

}  // namespace hogel::render::epi
