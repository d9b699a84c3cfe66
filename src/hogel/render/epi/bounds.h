// SPDX-License-Identifier: Apache-2.0
// What epi_draw_simd.cpp knows of strips before it draws them; included after hwy/highway.h, once for every instruction
// set.
#if defined(HOGEL_RENDER_EPI_BOUNDS) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_RENDER_EPI_BOUNDS
#undef HOGEL_RENDER_EPI_BOUNDS
#else
#define HOGEL_RENDER_EPI_BOUNDS
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "hogel/render/epi/hits.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// In about processor cycles: a vector of directions or columns, candidates in it, a hit that is put in its place by
// itself, a column of directions at once.
constexpr float cost_of_vector = 20, cost_of_candidates = 12, cost_of_hit = 3, cost_of_row = 7;

constexpr std::size_t max_lanes = HWY_MAX_BYTES / 4;

// Bounds of what a vector of strips can cover, and the way to go over each that takes least.
struct Bounded {
    enum PropagationOptions : std::int32_t { nowhere, rows, directions, columns };
    HWY_ALIGN float n_begin[max_lanes], n_end[max_lanes], per_z0[max_lanes], per_z1[max_lanes], margin[max_lanes],
        K_begin[max_lanes], K_end[max_lanes];
    HWY_ALIGN std::int32_t way[max_lanes], nearest[max_lanes];
};

// Of the samples of a plane.
struct Extent {
    float n_first, n_last, k_first, k_last;
    bool fronts_only;
};

// @param ends  x0, z0, x1, z1 of a vector of strips
HWY_NOINLINE inline void bound_strips(const float* ends, const Extent& plane, Bounded& to) {
    const FloatTag d;
    const IntTag di;
    const StripLanes strip = strip_a_lane(ends);
    const auto& [x0, z0, x1, z1] = strip;
    const Floats n_first = hn::Set(d, plane.n_first), n_last = hn::Set(d, plane.n_last);
    const Floats k_first = hn::Set(d, plane.k_first), k_last = hn::Set(d, plane.k_last);
    const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f), lanes = hn::Set(d, static_cast<float>(hn::Lanes(d)));
    const auto least = [](Floats a, Floats b, Floats c, Floats e)
                           HWY_ATTR { return hn::Min(hn::Min(a, b), hn::Min(c, e)); };
    const auto most = [](Floats a, Floats b, Floats c, Floats e)
                          HWY_ATTR { return hn::Max(hn::Max(a, b), hn::Max(c, e)); };

    // c is linear in K: these bound the columns that see a strip.
    const Floats c[] = {strip.c0(k_first), strip.c0(k_last), strip.c1(k_first), strip.c1(k_last)};
    const Floats low = least(c[0], c[1], c[2], c[3]), high = most(c[0], c[1], c[2], c[3]);
    FloatMask seen = hn::And(hn::Ge(high, n_first), hn::Lt(low, n_last));
    if (plane.fronts_only) {
        // Beyond the rounding of c.
        const Floats max_steps = hn::Max(hn::Abs(k_first), hn::Abs(k_last));
        const Floats size =
            hn::Add(hn::Max(hn::Abs(x0), hn::Abs(x1)), hn::Mul(max_steps, hn::Max(hn::Abs(z0), hn::Abs(z1))));
        const Floats back = hn::Mul(hn::Set(d, -1e-6f), size);
        seen = hn::And(seen, hn::Or(hn::Ge(hn::Sub(c[2], c[0]), back), hn::Ge(hn::Sub(c[3], c[1]), back)));
    }
    // c is monotonic in K, also as it is rounded.
    const Floats n_begin = hn::Max(n_first, hn::Add(hn::Floor(low), one)), n_end = hn::Min(n_last, hn::Floor(high));

    // Column n sees p in direction (x_p − n) / z_p. If both ends lie on one side of the hologram, the directions that
    // see the strip lie between; else outside, up to infinity.
    const Floats per_z0 = hn::Div(one, z0), per_z1 = hn::Div(one, z1);
    const Floats steepest = hn::Max(hn::Abs(per_z0), hn::Abs(per_z1));
    // Many times the rounding of these directions and of c.
    const float farthest = std::max(std::abs(plane.n_first), std::abs(plane.n_last)) + plane.k_last;
    const Floats margin = hn::Add(hn::Set(d, 0.01f), hn::Mul(hn::Set(d, 1e-6f * farthest), hn::Add(one, steepest)));
    const FloatMask one_side = hn::Not(hn::Xor(hn::Gt(z0, zero), hn::Gt(z1, zero)));
    const FloatMask bounded = hn::And(one_side, hn::Lt(margin, hn::Set(d, 0.5f)));
    const Floats K0 = hn::Mul(hn::Sub(x0, n_begin), per_z0), K1 = hn::Mul(hn::Sub(x0, n_end), per_z0),
                 K2 = hn::Mul(hn::Sub(x1, n_begin), per_z1), K3 = hn::Mul(hn::Sub(x1, n_end), per_z1);
    // Directions are whole steps from the first one.
    const Floats K_low = hn::Ceil(hn::Sub(hn::Sub(least(K0, K1, K2, K3), margin), k_first));
    const Floats K_begin = hn::IfThenElse(bounded, hn::Add(k_first, hn::Max(zero, K_low)), k_first);
    const Floats K_end = hn::IfThenElse(bounded, hn::Min(k_last, hn::Add(most(K0, K1, K2, K3), margin)), k_last);

    const Floats directions = hn::Sub(K_end, K_begin), columns = hn::Sub(n_end, n_begin);
    const Floats K_vectors = hn::Add(hn::Div(directions, lanes), one);
    const Floats n_vectors = hn::Add(hn::Div(columns, lanes), one);
    const Floats middle = hn::Mul(hn::Set(d, 0.5f), hn::Add(K_begin, K_end));
    const Floats across = hn::Abs(hn::Sub(hn::Sub(x1, x0), hn::Mul(middle, hn::Sub(z1, z0))));
    const Floats hits = hn::Mul(hn::Set(d, cost_of_hit), hn::Mul(across, hn::Add(directions, one)));
    const auto each = [&](Floats of_one) HWY_ATTR {
        return hn::Add(hn::Set(d, cost_of_vector), hn::Mul(hn::Set(d, cost_of_candidates), hn::Add(of_one, one)));
    };
    const Floats by_directions = hn::Add(hn::Mul(K_vectors, each(across)), hits);
    const Floats by_columns = hn::Add(hn::Mul(n_vectors, each(hn::Mul(across, steepest))), hits);
    Ints way = hn::IfThenElse(hn::RebindMask(di, hn::And(bounded, hn::Lt(by_columns, by_directions))),
                              hn::Set(di, Bounded::columns), hn::Set(di, Bounded::directions));
    const Floats deepest = hn::Max(hn::Abs(z0), hn::Abs(z1));
    // Beyond the rounding of a sample's depth.
    const Floats nearest = hn::Sub(hn::Min(z0, z1), hn::Mul(hn::Set(d, 1e-6f), deepest));
#if HWY_TARGET != HWY_SCALAR
    const Floats steps = hn::Add(hn::Add(across, hn::Mul(lanes, deepest)), one);
    const Floats by_rows =
        hn::Mul(K_vectors, hn::Add(hn::Set(d, cost_of_vector), hn::Mul(hn::Set(d, cost_of_row), steps)));
    const FloatMask rows = hn::And(bounded, hn::Lt(by_rows, hn::Min(by_directions, by_columns)));
    way = hn::IfThenElse(hn::RebindMask(di, rows), hn::Set(di, Bounded::rows), way);
#endif
    seen = hn::And(seen, hn::And(hn::Le(n_begin, n_end), hn::Le(K_begin, K_end)));
    way = hn::IfThenElseZero(hn::RebindMask(di, seen), way);
    hn::Store(n_begin, d, to.n_begin);
    hn::Store(n_end, d, to.n_end);
    hn::Store(per_z0, d, to.per_z0);
    hn::Store(per_z1, d, to.per_z1);
    hn::Store(margin, d, to.margin);
    hn::Store(K_begin, d, to.K_begin);
    hn::Store(K_end, d, to.K_end);
    hn::Store(way, di, to.way);
    hn::Store(ordered_bits_of(nearest), di, to.nearest);
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel::render::epi
HWY_AFTER_NAMESPACE();
#endif
