// SPDX-License-Identifier: Apache-2.0
// Fills the knots of all visible spans of a plane from the radiance cache before the plane is shaded, for every SIMD
// target. The plain version fills each knot at its first use by a sample.
#include <algorithm>
#include <cstddef>
#include <limits>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/render/epi/shaded_spans.h"
#include "hogel/render/epi/shading_lanes.h"
#include "hogel/render/sample_store.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void FillVisibleKnots(std::span<const std::uint64_t>, std::span<const SpanValues>, ShadedSpans&, const RadianceSource&,
                      bool) {}
#else
constexpr std::size_t max_lanes = hn::MaxLanes(FloatTag());

// Collects the numbers of visible spans that are pending, and clears their pending flags.
class PendingSpans {
  public:
    PendingSpans(std::uint8_t* pending, std::uint32_t* found) : pending_(pending), found_(found) {}

    HWY_INLINE void visit(std::uint32_t number) {
        found_[count_] = number;
        count_ += pending_[number];
        pending_[number] = 0;
    }
    std::size_t count() const { return count_; }

  private:
    std::uint8_t* pending_;
    std::uint32_t* found_;
    std::size_t count_ = 0;
};

// Writes the numbers of the pending spans in these words, each once. Returns their number.
HWY_INLINE std::size_t find_pending(std::span<const std::uint64_t> words, std::uint8_t* pending, std::uint32_t* found) {
    const NumberTag d;
    constexpr std::size_t lanes = hn::MaxLanes(d), usual_runs = 4;
    PendingSpans spans(pending, found);
    if (words.empty()) return 0;
    spans.visit(static_cast<std::uint32_t>(words[0]));
    std::size_t i = 1;
    for (; i + lanes <= words.size(); i += lanes) {
        // Visits only the first word of each run. There are usually few runs, and number 0 is never pending.
        const Numbers numbers = numbers_of(words.data() + i), previous = numbers_of(words.data() + i - 1);
        const auto begins = hn::Ne(numbers, previous);
        const std::size_t count = hn::CountTrue(d, begins);
        HWY_ALIGN std::uint32_t runs[lanes];
        hn::Store(hn::IfThenElseZero(hn::FirstN(d, count), hn::Compress(numbers, begins)), d, runs);
        for (std::size_t k = 0; k < usual_runs; ++k) spans.visit(runs[k]);
        if constexpr (lanes > usual_runs)
            for (std::size_t k = usual_runs; k < count; ++k) spans.visit(runs[k]);
    }
    for (; i < words.size(); ++i) spans.visit(static_cast<std::uint32_t>(words[i]));
    return spans.count();
}

struct SpansOnGrids {
    HWY_ALIGN float start[2][max_lanes], change[2][max_lanes], scale[2][max_lanes], limit[2][max_lanes],
        intervals[max_lanes];
    const shading::LightGrid* grids[max_lanes];
};

HWY_INLINE void place_on_grids(const RadianceSource::Grids& grids, const std::uint32_t* numbers, std::size_t count,
                               SpansOnGrids& lanes) {
    const FloatTag d;
    const NumberTag du;
    const hn::RebindToSigned<FloatTag> di;
    static_assert(offsetof(shading::LightGrid, rows) == 8 && offsetof(shading::LightGrid, corner) == 24 &&
                  sizeof(SpanOrigin) == 16 && offsetof(SpanOrigin, lone) == 12);
    const float *origins[max_lanes], *bases[max_lanes];
    for (std::size_t i = 0; i < max_lanes; ++i) {
        const SpanOrigin& origin = grids.of_spans[numbers[std::min(i, count - 1)]];
        lanes.grids[i] = &grids.of_triangles[origin.triangle];
        origins[i] = &origin.weight0;
        bases[i] = reinterpret_cast<const float*>(lanes.grids[i]);
    }
    Floats origin[4], grid[4], grid_end[4];
    for (std::size_t i = 0; i < 4; ++i) {
        origin[i] = load_blocks(origins + i, 0);
        grid[i] = load_blocks(bases + i, 0);
        grid_end[i] = load_blocks(bases + i, 4);
    }
    transpose(origin);
    transpose(grid);
    transpose(grid_end);
    const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const auto [weight0, weight1, unused, lone_and_next] = origin;
    const Numbers lone = hn::And(hn::BitCast(du, lone_and_next), hn::Set(du, 0xffff)),
                  next = hn::ShiftRight<16>(hn::BitCast(du, lone_and_next));
    // Weights of a corner at the two ends (SpanOrigin::weights).
    const auto weights = [&](Numbers corner, Floats(&weight)[2]) HWY_ATTR {
        const auto is_lone = hn::RebindMask(d, hn::Eq(corner, lone)), is_next = hn::RebindMask(d, hn::Eq(corner, next));
        weight[0] = hn::IfThenElse(is_lone, weight0, hn::IfThenElse(is_next, hn::Sub(one, weight0), zero));
        weight[1] = hn::IfThenElse(is_lone, weight1, hn::IfThenElse(is_next, zero, hn::Sub(one, weight1)));
    };
    const Numbers corner = hn::BitCast(du, grid_end[2]);
    Floats of_corner[2], of_last[2];
    weights(corner, of_corner);
    weights(hn::IfThenElse(hn::Eq(corner, hn::Zero(du)), hn::Set(du, 2), hn::Sub(corner, hn::Set(du, 1))), of_last);
    const Floats ends[2][2] = {{hn::Sub(one, of_corner[0]), hn::Sub(one, of_corner[1])}, {of_last[0], of_last[1]}};
    Floats max_cells = zero;
    for (int i = 0; i < 2; ++i) {
        const Floats cells = hn::ConvertTo(d, hn::BitCast(di, grid[2 + i]));
        const Floats on_axis = hn::Max(cells, one), scale = hn::Add(on_axis, hn::Set(d, 2 * shading::LightGrid::inset));
        const Floats change = hn::Sub(ends[i][1], ends[i][0]);
        max_cells = hn::Max(max_cells, hn::IfThenElseZero(hn::Gt(cells, zero), hn::Mul(hn::Abs(change), scale)));
        hn::Store(ends[i][0], d, lanes.start[i]);
        hn::Store(change, d, lanes.change[i]);
        hn::Store(scale, d, lanes.scale[i]);
        hn::Store(hn::Sub(on_axis, hn::Set(d, 1.25f)), d, lanes.limit[i]);
    }
    const Floats intervals =
        hn::Min(hn::Mul(hn::Set(d, SpanOnGrid::per_cell), max_cells), hn::Set(d, SpanOnGrid::max_intervals - 1));
    hn::Store(hn::Add(hn::ConvertTo(d, hn::ConvertTo(di, intervals)), one), d, lanes.intervals);
}

// Computes LightGrid::Cell: returns the index of a row or column, and sets the position `beyond` it, in cells.
HWY_INLINE Numbers place_on_axis(Floats fraction, float scale, float limit, Floats& beyond) {
    const FloatTag d;
    const NumberTag du;
    const Floats clamped = hn::Min(hn::Max(fraction, hn::Zero(d)), hn::Set(d, 1.0f));
    const Floats scaled = hn::Sub(hn::Mul(clamped, hn::Set(d, scale)), hn::Set(d, shading::LightGrid::inset + 0.5f));
    const Floats to_whole = hn::Set(d, shading::LightGrid::to_whole);
    const Floats rounded = hn::Add(hn::Min(hn::Max(scaled, hn::Set(d, -0.25f)), hn::Set(d, limit)), to_whole);
    beyond = hn::Add(hn::Sub(scaled, hn::Sub(rounded, to_whole)), hn::Set(d, 0.5f));
    return hn::And(hn::BitCast(du, rounded), hn::Set(du, shading::LightGrid::node_bits));
}

// Knots of several spans, for prefetching their cache points: the offset of the upper left point in words, and the
// fractions of the distance to the next points, for each knot.
class KnotBatch {
  public:
    explicit KnotBatch(bool colour) : colour_(colour) {}

    // Adds the knots of the span in a lane; the first one is knot number `first_knot`.
    HWY_INLINE void add(const SpansOnGrids& spans, std::size_t lane, const SpanValues& values,
                        std::uint32_t first_knot) {
        const FloatTag d;
        const NumberTag du;
        const shading::LightGrid& grid = *spans.grids[lane];
        Span& span = spans_[span_count_++];
        span = {grid.points,
                grid.columns > 0 ? grid.right : 0,
                grid.rows > 0 ? grid.down : 0,
                first_knot,
                count_,
                count_ + static_cast<std::size_t>(spans.intervals[lane]) + 1};
        const auto set = [d, lane](const float* lanes) HWY_ATTR { return hn::Set(d, lanes[lane]); };
        for (std::size_t first = count_; first < span.end; first += hn::Lanes(d)) {
            const Floats position = hn::Div(hn::Iota(d, static_cast<float>(first - count_)), set(spans.intervals));
            const Floats towards = hn::Add(set(spans.start[0]), hn::Mul(position, set(spans.change[0])));
            const Floats last = hn::Add(set(spans.start[1]), hn::Mul(position, set(spans.change[1])));
            const Floats along = hn::Div(last, hn::Max(towards, hn::Set(d, 1e-30f)));
            Floats down, right;
            const Numbers rows = place_on_axis(towards, spans.scale[0][lane], spans.limit[0][lane], down);
            const Numbers columns = place_on_axis(along, spans.scale[1][lane], spans.limit[1][lane], right);
            hn::StoreU(hn::Add(hn::Mul(rows, hn::Set(du, span.down)), hn::Mul(columns, hn::Set(du, span.right))), du,
                       upper_ + first);
            hn::StoreU(down, d, down_ + first);
            hn::StoreU(right, d, right_ + first);
            hn::StoreU(hn::Add(hn::Set(d, values.value0[3]), hn::Mul(position, hn::Set(d, values.difference[3]))), d,
                       depth_ + first);
        }
        for (std::size_t i = count_; i < span.end; ++i) {
            __builtin_prefetch(span.points + upper_[i]);
            __builtin_prefetch(span.points + upper_[i] + span.down);
        }
        count_ = span.end;
    }
    bool is_full() const { return count_ > max_knots || span_count_ == max_spans; }

    // Fills all knots of the batch and empties it.
    HWY_INLINE void fill(ShadedSpans::Knot* knots) {
        for (std::size_t k = 0; k < span_count_; ++k) {
            const Span& span = spans_[k];
            for (std::size_t i = span.begin; i < span.end; ++i)
                fill_knot(span, i, knots[span.first_knot + i - span.begin]);
        }
        count_ = span_count_ = 0;
    }

    static constexpr std::size_t max_intervals = 512;  // maximum per span

  private:
    struct Span {
        const std::uint32_t* points;
        std::uint32_t right, down;  // words from a point to the next one
        std::uint32_t first_knot;
        std::size_t begin, end;  // range of its knots in the batch
    };

    HWY_INLINE void fill_knot(const Span& span, std::size_t i, ShadedSpans::Knot& knot) const {
        using Tag = hn::Full128<float>;
        using Four = hn::Vec<Tag>;
        const Tag d;
        const std::uint32_t *upper = span.points + upper_[i], *lower = upper + span.down;
        if (HWY_UNLIKELY(!shading::LightGrid::are_filled(upper, upper + span.right, lower, lower + span.right))) {
            knot[3] = std::numeric_limits<float>::quiet_NaN();
            return;
        }
        const auto load = [d](const std::uint32_t* point)
                              HWY_ATTR { return hn::Load(d, reinterpret_cast<const float*>(point)); };
        const auto interpolate = [](Four v, Four w, Four fraction)
                                     HWY_ATTR { return hn::Add(v, hn::Mul(fraction, hn::Sub(w, v))); };
        const Four right = hn::Set(d, right_[i]);
        const Four radiance =
            hn::Max(interpolate(interpolate(load(upper), load(upper + span.right), right),
                                interpolate(load(lower), load(lower + span.right), right), hn::Set(d, down_[i])),
                    hn::Zero(d));
        hn::StoreU(hn::IfThenElse(hn::FirstN(d, 3), radiance, hn::Set(d, depth_[i])), d, knot.data());
        if (!colour_) knot = {luminance({knot[0], knot[1], knot[2]}), 0, 0, knot[3]};
    }

    static constexpr std::size_t max_knots = 256, max_spans = 64, capacity = max_knots + max_intervals + 1 + max_lanes;
    bool colour_;
    std::size_t count_ = 0, span_count_ = 0;
    Span spans_[max_spans];
    std::uint32_t upper_[capacity];
    float down_[capacity], right_[capacity], depth_[capacity];
};

void FillVisibleKnots(std::span<const std::uint64_t> words, std::span<const SpanValues> values, ShadedSpans& spans,
                      const RadianceSource& source, bool colour) {
    if (!spans.has_cached()) return;
    const core::ThreadBuffer<std::uint32_t> pending(values.size() + 1);
    const std::size_t count = find_pending(words, spans.pending(), pending.data());
    if (count == 0) return;
    const RadianceSource::Grids grids = source.grids();
    SpansOnGrids on_grids;
    KnotBatch batch(colour);
    for (std::size_t first = 0; first < count; first += max_lanes) {
        const std::size_t batch_size = std::min(max_lanes, count - first);
        place_on_grids(grids, &pending[first], batch_size, on_grids);
        for (std::size_t i = 0; i < batch_size; ++i) {
            const std::size_t number = pending[first + i];
            const float intervals = on_grids.intervals[i];
            if (intervals > KnotBatch::max_intervals) {
                spans.add_pending_knots(number, intervals);
                continue;
            }
            batch.add(on_grids, i, values[number], spans.add_knots(number, intervals));
            if (batch.is_full()) batch.fill(spans.knots());
        }
    }
    batch.fill(spans.knots());
}
#endif

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::render::epi {
HOGEL_DISPATCH(fill_visible_knots, FillVisibleKnots);
}  // namespace hogel::render::epi
