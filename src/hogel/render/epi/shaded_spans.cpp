// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/shaded_spans.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "hogel/render/sample_store.h"

namespace hogel::render::epi {
namespace {

using Knot = ShadedSpans::Knot;

constexpr float pending_depth = std::numeric_limits<float>::quiet_NaN();

shading::RadianceCache::Corners corners_of(const SpanOnGrid& grid, const shading::LightGrid::Cell& row,
                                           const shading::LightGrid::Cell& column, std::size_t span,
                                           const RadianceSource& source) {
    const std::uint32_t* first =
        grid.points + std::uint64_t{row.node} * grid.down + std::uint64_t{column.node} * grid.right;
    const std::array points{first, first + grid.right, first + grid.down, first + grid.down + grid.right};
    if (!shading::LightGrid::are_filled(points[0], points[1], points[2], points[3]))
        return source.corners(span, row.node, column.node);
    shading::RadianceCache::Corners corners{};
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < 3; ++i) corners[k][i] = std::bit_cast<float>(points[k][i]);
    return corners;
}

// Returns the cached radiance at a position on a span, with a zero in place of the depth.
Knot cached_radiance(const SpanOnGrid& grid, float position, std::size_t span, const RadianceSource& source) {
    const float towards = grid.start[0] + position * grid.change[0], last = grid.start[1] + position * grid.change[1];
    const shading::LightGrid::Cell row(towards, grid.axis[0]);
    const shading::LightGrid::Cell column(shading::LightGrid::along(towards, last), grid.axis[1]);
    const shading::RadianceCache::Corners corner = corners_of(grid, row, column, span, source);
    Knot value;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const float upper = corner[0][i] + column.fraction * (corner[1][i] - corner[0][i]);
        const float lower = corner[2][i] + column.fraction * (corner[3][i] - corner[2][i]);
        value[i] = std::max(0.0f, upper + row.fraction * (lower - upper));
    }
    return value;
}

Knot value_between_ends(const SpanValues& span, float position) {
    Knot value;
    for (std::size_t i = 0; i < value.size(); ++i) value[i] = span.value0[i] + position * span.difference[i];
    return value;
}

}  // namespace

SpanOnGrid::SpanOnGrid(const shading::LightGrid& grid, const SpanOrigin& span)
    : axis{shading::LightGrid::Axis(grid.rows), shading::LightGrid::Axis(grid.columns)},
      points(grid.points),
      down(grid.rows > 0 ? grid.down : 0),
      right(grid.columns > 0 ? grid.right : 0) {
    const std::array weights0 = span.weights(0), weights1 = span.weights(1);
    start[0] = grid.towards(weights0);
    start[1] = grid.last(weights0);
    change[0] = grid.towards(weights1) - start[0];
    change[1] = grid.last(weights1) - start[1];
}

float SpanOnGrid::intervals() const {
    const float rows = down > 0 ? std::abs(change[0]) * axis[0].scale : 0,
                columns = right > 0 ? std::abs(change[1]) * axis[1].scale : 0;
    const float intervals = std::min(per_cell * std::max(rows, columns), max_intervals - 1);
    return static_cast<float>(static_cast<std::int32_t>(intervals) + 1);
}

void ShadedSpans::clear(const SpanValues& background) {
    spans_.clear();
    pending_.clear();
    has_cached_ = false;
    used_ = 0;
    take_knots(2);
    knots_[0] = knots_[1] = {0, 0, 0, pending_depth};
    SpanValues without_depth = background;
    without_depth.value0[3] = without_depth.difference[3] = 0;
    add_between_ends(without_depth);
}

std::uint32_t ShadedSpans::take_knots(std::size_t count) {
    const std::size_t first = used_;
    used_ += count;
    if (knots_.size() < used_) knots_.resize(2 * used_);
    return static_cast<std::uint32_t>(first);
}

void ShadedSpans::add_span(const SpanValues& values, RadianceFrom from, std::uint32_t first_knot) {
    Span& span = spans_.emplace_back(Span{values.x0, values.z0, values.dx, values.dz, 0, 0, 0, from});
    span.set_knots(first_knot, 1);
    pending_.push_back(from == RadianceFrom::cache ? 1 : 0);
    has_cached_ |= from == RadianceFrom::cache;
}

void ShadedSpans::add_between_ends(const SpanValues& span) {
    const std::uint32_t first = take_knots(2);
    add_span(span, RadianceFrom::ends, first);
    knots_[first] = value_between_ends(span, 0);
    knots_[first + 1] = value_between_ends(span, 1);
}

void ShadedSpans::add(const SpanValues& span, RadianceFrom from) { add_span(span, from, pending_knots); }

std::uint32_t ShadedSpans::add_knots(std::size_t number, float intervals) {
    const std::uint32_t first = take_knots(static_cast<std::size_t>(intervals) + 1);
    spans_[number].set_knots(first, intervals);
    pending_[number] = 0;
    return first;
}

void ShadedSpans::add_pending_knots(std::size_t number, float intervals) {
    const std::uint32_t first = add_knots(number, intervals);
    std::fill_n(knots_.begin() + first, static_cast<std::size_t>(intervals) + 1, Knot{0, 0, 0, pending_depth});
}

void fill_knots_around(float position, std::size_t number, const SpanValues& values, ShadedSpans& spans,
                       const RadianceSource& source, bool colour) {
    const auto [origins, grids] = source.grids();
    const SpanOnGrid grid(grids[origins[number].triangle], origins[number]);
    const ShadedSpans::Span& span = spans.spans()[number];
    const std::uint32_t interval = ShadedSpans::Interval(span, position).index;
    for (std::uint32_t i = interval; i <= interval + 1; ++i) {
        Knot& knot = spans.knots()[span.first_knot() + i];
        if (!std::isnan(knot[3])) continue;
        const float knot_position = static_cast<float>(i) / span.intervals;
        knot = cached_radiance(grid, knot_position, number, source);
        if (!colour) knot = {luminance({knot[0], knot[1], knot[2]}), 0, 0, 0};
        knot[3] = values.value0[3] + knot_position * values.difference[3];
    }
}

void shade_between_knots_plain(const EpipolarPlane& plane, std::span<const SpanValues> values, ShadedSpans& spans,
                               const RadianceSource& source, const PlaneOutput& out) {
    const bool colour = out.values[1] != nullptr;
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t k = 0; k < plane.directions; ++k) {
            std::uint64_t& word = plane.words[column * plane.directions + k];
            const std::size_t number = word & 0xffffffff;
            word = EpipolarPlane::empty;
            const SpanValues& span_values = values[number];
            const ShadedSpans::Span& span = spans.spans()[number];
            const float n = static_cast<float>(plane.first_column) + static_cast<float>(column);
            const float position = position_on_span(span_values, n, plane.first_direction + static_cast<float>(k));
            Knot value;
            if (number == EpipolarPlane::background) {
                value = value_between_ends(span_values, 0);
            } else if (span.from == RadianceFrom::samples) {
                const Rgb radiance = source.radiance(number, position, column, k);
                value = value_between_ends(span_values, position);
                value = {colour ? radiance.r : luminance(radiance), radiance.g, radiance.b, value[3]};
            } else {
                if (span.from == RadianceFrom::cache) {
                    const auto [origins, grids] = source.grids();
                    const SpanOrigin& origin = origins[number];
                    if (spans.pending()[number] != 0)
                        spans.add_pending_knots(number, SpanOnGrid(grids[origin.triangle], origin).intervals());
                    fill_knots_around(position, number, span_values, spans, source, colour);
                }
                const ShadedSpans::Interval interval(span, position);
                const Knot* knot = spans.knots() + span.first_knot() + interval.index;
                for (std::size_t i = 0; i < value.size(); ++i)
                    value[i] = knot[0][i] + interval.fraction * (knot[1][i] - knot[0][i]);
            }
            for (std::size_t i = 0; i < 4; ++i)
                if (out.values[i]) out.values[i][column * out.strides[i] + k] = value[i];
        }
}

}  // namespace hogel::render::epi
