// SPDX-License-Identifier: Apache-2.0
// Bounds of the samples that spans can cover, computed before drawing, for draw_simd.cpp. To be included after
// hwy/highway.h, once for every SIMD target.
#if defined(HOGEL_RENDER_EPI_SPAN_BOUNDS) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_RENDER_EPI_SPAN_BOUNDS
#undef HOGEL_RENDER_EPI_SPAN_BOUNDS
#else
#define HOGEL_RENDER_EPI_SPAN_BOUNDS
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "hogel/render/epi/hits.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Approximate costs in processor cycles of: a vector of directions or columns; one candidate in it; a queued hit; and a
// column of a vector of directions that is drawn in place.
constexpr float cost_of_vector = 20, cost_of_candidates = 12, cost_of_hit = 3, cost_of_row = 7;

constexpr std::size_t max_lanes = HWY_MAX_BYTES / 4;

// Bounds of the samples that each of a vector of spans can cover, and the cheapest order of drawing it.
struct SpanBounds {
    enum Order : std::int32_t { none, rows, directions, columns };  // `none` if no sample sees the span
    HWY_ALIGN float n_begin[max_lanes], n_end[max_lanes], per_z0[max_lanes], per_z1[max_lanes], margin[max_lanes],
        K_begin[max_lanes], K_end[max_lanes];
    HWY_ALIGN std::int32_t order[max_lanes];
    HWY_ALIGN std::int32_t min_depth[max_lanes];  // ordered bits of a depth in front of the whole span
};

struct PlaneExtent {
    float n_first, n_last, k_first, k_last;
    bool fronts_only;
};

HWY_INLINE Floats min_of(Floats a, Floats b, Floats c, Floats e) { return hn::Min(hn::Min(a, b), hn::Min(c, e)); }
HWY_INLINE Floats max_of(Floats a, Floats b, Floats c, Floats e) { return hn::Max(hn::Max(a, b), hn::Max(c, e)); }

// Columns that see a span in some direction of the plane.
struct ColumnBounds {
    Floats begin, end;
    FloatMask visible;
};

HWY_INLINE ColumnBounds bound_columns(const SpanLanes& span, const PlaneExtent& plane) {
    const FloatTag d;
    const Floats n_first = hn::Set(d, plane.n_first), n_last = hn::Set(d, plane.n_last);
    const Floats k_first = hn::Set(d, plane.k_first), k_last = hn::Set(d, plane.k_last);
    // c is linear in K, so these bound the columns.
    const Floats c[] = {span.c0(k_first), span.c0(k_last), span.c1(k_first), span.c1(k_last)};
    const Floats low = min_of(c[0], c[1], c[2], c[3]), high = max_of(c[0], c[1], c[2], c[3]);
    FloatMask visible = hn::And(hn::Ge(high, n_first), hn::Lt(low, n_last));
    if (plane.fronts_only) {
        // A margin larger than the rounding error of c.
        const Floats max_K = hn::Max(hn::Abs(k_first), hn::Abs(k_last));
        const Floats size = hn::Add(hn::Max(hn::Abs(span.x0), hn::Abs(span.x1)),
                                    hn::Mul(max_K, hn::Max(hn::Abs(span.z0), hn::Abs(span.z1))));
        const Floats margin = hn::Mul(hn::Set(d, -1e-6f), size);
        visible = hn::And(visible, hn::Or(hn::Ge(hn::Sub(c[2], c[0]), margin), hn::Ge(hn::Sub(c[3], c[1]), margin)));
    }
    // c is monotonic in K, even after rounding.
    return {hn::Max(n_first, hn::Add(hn::Floor(low), hn::Set(d, 1.0f))), hn::Min(n_last, hn::Floor(high)), visible};
}

// Directions in which some of these columns see a span.
struct DirectionBounds {
    Floats begin, end, per_z0, per_z1, max_per_z, margin;
    FloatMask bounded;  // lanes without bounds can have all directions of the plane
};

// Column n sees p in direction (x_p − n) / z_p. If both ends are on one side of the hologram, the directions that see
// the span are between those of the ends; otherwise they are outside of that range, up to infinity.
HWY_INLINE DirectionBounds bound_directions(const SpanLanes& span, const ColumnBounds& n, const PlaneExtent& plane) {
    const FloatTag d;
    const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const Floats k_first = hn::Set(d, plane.k_first), k_last = hn::Set(d, plane.k_last);
    const Floats per_z0 = hn::Div(one, span.z0), per_z1 = hn::Div(one, span.z1);
    const Floats max_per_z = hn::Max(hn::Abs(per_z0), hn::Abs(per_z1));
    // Many times the rounding errors of these directions and of c.
    const float size = std::max(std::abs(plane.n_first), std::abs(plane.n_last)) + plane.k_last;
    const Floats margin = hn::Add(hn::Set(d, 0.01f), hn::Mul(hn::Set(d, 1e-6f * size), hn::Add(one, max_per_z)));
    const FloatMask one_side = hn::Not(hn::Xor(hn::Gt(span.z0, zero), hn::Gt(span.z1, zero)));
    const FloatMask bounded = hn::And(one_side, hn::Lt(margin, hn::Set(d, 0.5f)));
    const Floats K0 = hn::Mul(hn::Sub(span.x0, n.begin), per_z0), K1 = hn::Mul(hn::Sub(span.x0, n.end), per_z0),
                 K2 = hn::Mul(hn::Sub(span.x1, n.begin), per_z1), K3 = hn::Mul(hn::Sub(span.x1, n.end), per_z1);
    // Directions are whole steps from the first one.
    const Floats first_step = hn::Ceil(hn::Sub(hn::Sub(min_of(K0, K1, K2, K3), margin), k_first));
    const Floats begin = hn::IfThenElse(bounded, hn::Add(k_first, hn::Max(zero, first_step)), k_first);
    const Floats end = hn::IfThenElse(bounded, hn::Min(k_last, hn::Add(max_of(K0, K1, K2, K3), margin)), k_last);
    return {begin, end, per_z0, per_z1, max_per_z, margin, bounded};
}

HWY_INLINE Ints cheapest_order(const SpanLanes& span, const ColumnBounds& n, const DirectionBounds& K) {
    const FloatTag d;
    const IntTag di;
    const Floats one = hn::Set(d, 1.0f), lanes = hn::Set(d, static_cast<float>(hn::Lanes(d)));
    const Floats directions = hn::Sub(K.end, K.begin), columns = hn::Sub(n.end, n.begin);
    const Floats K_vectors = hn::Add(hn::Div(directions, lanes), one);
    const Floats n_vectors = hn::Add(hn::Div(columns, lanes), one);
    const Floats middle = hn::Mul(hn::Set(d, 0.5f), hn::Add(K.begin, K.end));
    const Floats width = hn::Abs(hn::Sub(hn::Sub(span.x1, span.x0), hn::Mul(middle, hn::Sub(span.z1, span.z0))));
    const Floats hits = hn::Mul(hn::Set(d, cost_of_hit), hn::Mul(width, hn::Add(directions, one)));
    const auto vector_cost = [&](Floats candidates) HWY_ATTR {
        return hn::Add(hn::Set(d, cost_of_vector), hn::Mul(hn::Set(d, cost_of_candidates), hn::Add(candidates, one)));
    };
    const Floats by_directions = hn::Add(hn::Mul(K_vectors, vector_cost(width)), hits);
    const Floats by_columns = hn::Add(hn::Mul(n_vectors, vector_cost(hn::Mul(width, K.max_per_z))), hits);
    const FloatMask use_columns = hn::And(K.bounded, hn::Lt(by_columns, by_directions));
    Ints order = hn::IfThenElse(hn::RebindMask(di, use_columns), hn::Set(di, SpanBounds::columns),
                                hn::Set(di, SpanBounds::directions));
#if HWY_TARGET != HWY_SCALAR
    const Floats max_z = hn::Max(hn::Abs(span.z0), hn::Abs(span.z1));
    const Floats steps = hn::Add(hn::Add(width, hn::Mul(lanes, max_z)), one);
    const Floats by_rows =
        hn::Mul(K_vectors, hn::Add(hn::Set(d, cost_of_vector), hn::Mul(hn::Set(d, cost_of_row), steps)));
    const FloatMask use_rows = hn::And(K.bounded, hn::Lt(by_rows, hn::Min(by_directions, by_columns)));
    order = hn::IfThenElse(hn::RebindMask(di, use_rows), hn::Set(di, SpanBounds::rows), order);
#endif
    const FloatMask visible = hn::And(n.visible, hn::And(hn::Le(n.begin, n.end), hn::Le(K.begin, K.end)));
    return hn::IfThenElseZero(hn::RebindMask(di, visible), order);
}

// @param ends  x0, z0, x1, z1 of a vector of spans
HWY_NOINLINE inline void bound_spans(const float* ends, const PlaneExtent& plane, SpanBounds& bounds) {
    const FloatTag d;
    const IntTag di;
    const SpanLanes span = load_spans(ends);
    const ColumnBounds n = bound_columns(span, plane);
    const DirectionBounds K = bound_directions(span, n, plane);
    // A margin larger than the rounding error of a sample's depth.
    const Floats max_z = hn::Max(hn::Abs(span.z0), hn::Abs(span.z1));
    const Floats min_depth = hn::Sub(hn::Min(span.z0, span.z1), hn::Mul(hn::Set(d, 1e-6f), max_z));
    hn::Store(n.begin, d, bounds.n_begin);
    hn::Store(n.end, d, bounds.n_end);
    hn::Store(K.per_z0, d, bounds.per_z0);
    hn::Store(K.per_z1, d, bounds.per_z1);
    hn::Store(K.margin, d, bounds.margin);
    hn::Store(K.begin, d, bounds.K_begin);
    hn::Store(K.end, d, bounds.K_end);
    hn::Store(cheapest_order(span, n, K), di, bounds.order);
    hn::Store(ordered_bits_of(min_depth), di, bounds.min_depth);
}

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
