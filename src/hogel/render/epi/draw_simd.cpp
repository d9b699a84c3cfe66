// SPDX-License-Identifier: Apache-2.0
// Vector version of draw_spans_plain in kernels.cpp for every SIMD target.
#include <algorithm>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/render/epi/hits.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/span_bounds.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// `directions`: order of directions in lanes such that interleaving writes words contiguously. `steps`: 0, 1, 2, …
struct LaneOrder {
    HWY_ALIGN float directions[max_lanes], steps[max_lanes];

    LaneOrder() {
        const std::size_t half = hn::Lanes(FloatTag()) / 2;
        for (std::size_t i = 0; i < 2 * half; ++i) {
            const std::size_t direction = i % 4 / 2 * half + i / 4 * 2 + i % 2;
            directions[i] = static_cast<float>(direction);
            steps[i] = static_cast<float>(i);
        }
    }
};

struct DrawJob {
    const EpiSpan& span;
    std::uint32_t index, number;
    const EpipolarPlane& plane;
    Hits& hits;
    Candidates& candidates;
    const PlaneExtent& extent;
    const LaneOrder& lanes;
    std::uint32_t min_depth;  // see SpanBounds
};

// Computes the columns that see a span, for each of a vector of rows of cells.
HWY_INLINE void columns_of_rows(const SpanLanes& span, const PlaneExtent& extent, std::size_t first_row, float K_end,
                                Floats& first, Floats& last) {
    const FloatTag d;
    const Floats one = hn::Set(d, 1.0f), size = hn::Set(d, static_cast<float>(directions_per_cell));
    const Floats K_low = hn::Add(hn::Set(d, extent.k_first + static_cast<float>(first_row * directions_per_cell)),
                                 hn::Mul(hn::Iota(d, 0), size));
    const Floats K_high = hn::Min(hn::Add(K_low, hn::Sub(size, one)), hn::Set(d, K_end));
    // c is monotonic in K, even after rounding.
    const Floats a = span.c0(K_low), b = span.c0(K_high), c = span.c1(K_low), e = span.c1(K_high);
    const Floats low = hn::Floor(hn::Min(hn::Min(a, b), hn::Min(c, e)));
    const Floats high = hn::Floor(hn::Max(hn::Max(a, b), hn::Max(c, e)));
    first = hn::Max(hn::Set(d, extent.n_first), hn::Add(low, one));
    last = hn::Min(hn::Set(d, extent.n_last), high);
}

#if HWY_TARGET != HWY_SCALAR
// Draws one column at a time, one direction per lane, so that the words are contiguous. Lanes without a hit keep their
// words, even beyond the plane's directions. Vectors are aligned to cells or parts of them. Skips occluded cells.
void draw_along_rows(const DrawJob& job, float K_begin, float K_end) {
    const FloatTag d;
    const IntTag di;
    const NumberTag du;
    const hn::RepartitionToWide<NumberTag> d64;
    const SpanLanes span = in_all_lanes(job.span);
    const std::size_t lanes = hn::Lanes(d), half = lanes / 2;
    const std::size_t plane_columns = job.plane.columns, directions = job.plane.directions;
    std::uint64_t* const plane_words = job.plane.words;
    const bool fronts_only = job.plane.fronts_only;
    const std::uint32_t* const max_depths = job.plane.cells->max_depth.data();
    const auto number = hn::Set(du, job.number), min_depth = hn::Set(du, job.min_depth);
    const Floats no_hit = hn::BitCast(d, hn::Set(di, -1));
    const Floats order = hn::Load(d, job.lanes.directions), last = hn::Set(d, K_end);
    const auto k_begin = static_cast<std::size_t>(K_begin - job.extent.k_first);
    const auto k_end = static_cast<std::size_t>(K_end - job.extent.k_first);
    const std::size_t row_end = k_end / directions_per_cell + 1;
    HWY_ALIGN float firsts[max_lanes];
    HWY_ALIGN std::int32_t columns[max_lanes], counts[max_lanes];
    std::size_t writes = 0;
    for (std::size_t group = k_begin / directions_per_cell; group < row_end; group += lanes) {
        Floats first_columns, last_columns;
        columns_of_rows(span, job.extent, group, K_end, first_columns, last_columns);
        hn::Store(first_columns, d, firsts);
        hn::Store(hn::ConvertTo(di, hn::Sub(first_columns, hn::Set(d, job.extent.n_first))), di, columns);
        hn::Store(hn::ConvertTo(di, hn::Add(hn::Sub(last_columns, first_columns), hn::Set(d, 1.0f))), di, counts);
        for (std::size_t row = group; row < std::min(row_end, group + lanes); ++row) {
            float first = firsts[row - group];
            auto column = static_cast<std::size_t>(columns[row - group]);
            for (std::int32_t count = counts[row - group]; count > 0;
                 count -= static_cast<std::int32_t>(lanes), first += static_cast<float>(lanes), column += lanes) {
                std::uint64_t open =
                    bits_of(du, hn::Not(hn::Lt(hn::LoadU(du, max_depths + row * plane_columns + column), min_depth)));
                open &= ~std::uint64_t{0} >> (64 - std::min(count, 32));
                if (open == 0) continue;
                writes += static_cast<std::size_t>(std::popcount(open));
                for (std::size_t k = row * directions_per_cell; k < (row + 1) * directions_per_cell && k <= k_end;
                     k += lanes) {
                    const Floats K = hn::Add(hn::Set(d, job.extent.k_first + static_cast<float>(k)), order);
                    const Floats c0 = span.c0(K);
                    const Floats c1 = hn::IfThenElse(hn::Le(K, last), span.c1(K, c0, fronts_only), c0);
                    const Floats slope = span.slope(c0, c1);
                    for (std::uint64_t remaining = open; remaining != 0; remaining &= remaining - 1) {
                        const auto step = static_cast<std::size_t>(std::countr_zero(remaining));
                        const Floats n = hn::Set(d, first + job.lanes.steps[step]);
                        const Floats z = hn::BitCast(d, ordered_bits_of(span.depth(n, c0, slope)));
                        const auto depth = hn::BitCast(du, hn::IfThenElse(SpanLanes::covers(n, c0, c1), z, no_hit));
                        std::uint64_t* words = plane_words + (column + step) * directions + k;
                        const auto low = hn::BitCast(d64, hn::InterleaveLower(du, number, depth));
                        const auto high = hn::BitCast(d64, hn::InterleaveUpper(du, number, depth));
                        hn::StoreU(hn::Min(low, hn::LoadU(d64, words)), d64, words);
                        hn::StoreU(hn::Min(high, hn::LoadU(d64, words + half)), d64, words + half);
                    }
                }
            }
        }
    }
    job.plane.cells->writes += writes;
}
#endif

// Draws one direction per lane: all columns between c_0 and c_1 are hits.
void draw_along_directions(const DrawJob& job, float K_begin, float K_end) {
    const FloatTag d;
    const IntTag di;
    const SpanLanes span = in_all_lanes(job.span);
    const Floats one = hn::Set(d, 1.0f), n_first = hn::Set(d, job.extent.n_first),
                 n_last = hn::Set(d, job.extent.n_last);
    const Floats none = hn::Set(d, job.extent.n_first - 1), K_last = hn::Set(d, K_end),
                 k_first = hn::Set(d, job.extent.k_first);
    const Ints directions = hn::Set(di, static_cast<std::int32_t>(job.plane.directions));
    for (float begin = K_begin; begin <= K_end; begin += static_cast<float>(hn::Lanes(d))) {
        const Floats K = hn::Iota(d, begin);
        const Floats c0 = span.c0(K), c1 = span.c1(K, c0, job.plane.fronts_only), slope = span.slope(c0, c1);
        const Floats end = hn::IfThenElse(hn::Le(K, K_last), hn::Min(n_last, hn::Floor(hn::Max(c0, c1))), none);
        const Ints k = hn::ConvertTo(di, hn::Sub(K, k_first));
        Floats n = hn::Max(n_first, hn::Add(hn::Floor(hn::Min(c0, c1)), one));
        for (FloatMask hit = hn::Le(n, end); !hn::AllFalse(d, hit); hit = hn::Le(n, end)) {
            const Ints column = hn::ConvertTo(di, hn::Sub(n, n_first));
            job.hits.add(hit, span.depth(n, c0, slope), hn::Add(hn::Mul(column, directions), k), job.number);
            n = hn::Add(n, one);
        }
    }
}

// State for continuing draw_along_columns(): first column of a vector, and number of directions done.
struct ColumnsDone {
    float begin, directions;
};

// Draws one column per lane. Candidates are the directions between those of the ends, K_0 and K_1, with a margin on
// either side. Returns false if the queue is full; draw the queue and call again to continue.
bool draw_along_columns(const DrawJob& job, float n_end, float per_z0, float per_z1, float margin,
                        ColumnsDone& progress) {
    const FloatTag d;
    Candidates& candidates = job.candidates;
    const Floats x0 = hn::Set(d, job.span.x0), x1 = hn::Set(d, job.span.x1);
    const Floats inverse0 = hn::Set(d, per_z0), inverse1 = hn::Set(d, per_z1);
    const Floats low_offset = hn::Set(d, job.extent.k_first + margin),
                 high_offset = hn::Set(d, job.extent.k_first - margin);
    const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f), none = hn::Set(d, -1.0f);
    const Floats k_last = hn::Set(d, job.extent.k_last - job.extent.k_first), columns_end = hn::Set(d, n_end);
    std::size_t count = candidates.begin();
    float done = progress.directions;
    for (float begin = progress.begin; begin <= n_end; begin += static_cast<float>(hn::Lanes(d)), done = 0) {
        const Floats n = hn::Iota(d, begin);
        const Floats K0 = hn::Mul(hn::Sub(x0, n), inverse0), K1 = hn::Mul(hn::Sub(x1, n), inverse1);
        const Floats low = hn::Sub(hn::Min(K0, K1), low_offset), high = hn::Sub(hn::Max(K0, K1), high_offset);
        const Floats end = hn::IfThenElse(hn::Le(n, columns_end), hn::Min(k_last, high), none);
        Floats k = hn::Add(hn::Max(zero, hn::Ceil(low)), hn::Set(d, done));
        // Most columns have one or two candidates.
        count += candidates.add(n, k, end, count);
        for (std::size_t added = 1; added != 0;) {
            k = hn::Add(k, one);
            done += 1;
            added = candidates.add(n, k, end, count);
            count += added;
            if (HWY_LIKELY(!Candidates::is_full(count))) continue;
            progress = {begin, done + 1};
            candidates.end(job.index, count);
            return false;
        }
    }
    candidates.end(job.index, count);
    return true;
}

void DrawSpans(std::span<const EpiSpan> spans, std::size_t first, const EpipolarPlane& plane) {
    const auto n_first = static_cast<float>(plane.first_column);
    const PlaneExtent extent{n_first, n_first + static_cast<float>(plane.columns) - 1, plane.first_direction,
                             plane.first_direction + static_cast<float>(plane.directions) - 1, plane.fronts_only};
    const LaneOrder order;
    Hits hits(plane);
    Candidates candidates(plane, spans, first, hits);
    const std::size_t lanes = hn::Lanes(FloatTag());
    SpanBounds bounds;
    HWY_ALIGN EpiSpan padded[max_lanes];
    for (std::size_t begin = 0; begin < spans.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, spans.size() - begin);
        const EpiSpan* batch = spans.data() + begin;
        if (count < lanes) {
            std::fill(padded, padded + lanes, *batch);
            batch = std::copy(batch, batch + count, padded) - count;
        }
        bound_spans(&batch->x0, extent, bounds);
        for (std::size_t i = 0; i < count; ++i) {
            const auto index = static_cast<std::uint32_t>(begin + i);
            const DrawJob job{batch[i], index, static_cast<std::uint32_t>(first) + index,      plane, hits, candidates,
                              extent,   order, static_cast<std::uint32_t>(bounds.min_depth[i])};
            switch (bounds.order[i]) {
#if HWY_TARGET != HWY_SCALAR
                case SpanBounds::rows:
                    draw_along_rows(job, bounds.K_begin[i], bounds.K_end[i]);
                    break;
#endif
                case SpanBounds::directions:
                    draw_along_directions(job, bounds.K_begin[i], bounds.K_end[i]);
                    break;
                case SpanBounds::columns:
                    for (ColumnsDone progress{bounds.n_begin[i], 0}; !draw_along_columns(
                             job, bounds.n_end[i], bounds.per_z0[i], bounds.per_z1[i], bounds.margin[i], progress);)
                        candidates.draw();
                    break;
                default:
                    break;
            }
        }
    }
    candidates.draw();
    hits.draw();
}

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::render::epi {
HOGEL_DISPATCH(draw_spans, DrawSpans);
}  // namespace hogel::render::epi
