// SPDX-License-Identifier: Apache-2.0
// Vector version of setup.cpp for every SIMD target, one triangle per lane.
#include <algorithm>
#include <cstring>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/render/epi/lane_bits.h"
#include "hogel/render/epi/setup.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// A single lane cannot hold the two doubles that load_pairs() needs.
void SetUpSpans(const TriangleClusters& clusters, std::span<const std::uint32_t> slots, const CutPlane& plane,
                EpiSpan* spans, SpanValues* values, SpanOrigin* origins) {
    set_up_spans_plain(clusters, slots, plane, spans, values, origins);
}
#else
#if HWY_HAVE_SCALABLE
using Tag = hn::FixedTag<double, 2>;
#else
using Tag = hn::ScalableTag<double>;
#endif
using IndexTag = hn::RebindToSigned<Tag>;
using HalfTag = hn::Rebind<float, Tag>;  // of the same length as Tag
using Doubles = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

constexpr std::size_t max_lanes = hn::MaxLanes(Tag());

// Loads two doubles at `offset` from each base: the first of each into `first`, the second into `second`.
HWY_INLINE void load_pairs(const double* const* bases, std::size_t offset, Doubles& first, Doubles& second) {
    const Tag d;
    // Loads from every second base, beginning with base i.
    const auto blocks = [&](std::size_t i) HWY_ATTR {
        if constexpr (max_lanes == 2) {
            return hn::LoadDup128(d, bases[i] + offset);
        } else if constexpr (max_lanes == 4) {
            return hn::OddEvenBlocks(hn::LoadDup128(d, bases[i + 2] + offset), hn::LoadDup128(d, bases[i] + offset));
        } else {
            // Half by half, because of the compiler error described at load_blocks().
            const hn::Half<Tag> dh;
            const auto half = [&](std::size_t k) HWY_ATTR {
                return hn::OddEvenBlocks(hn::LoadDup128(dh, bases[k + 2] + offset),
                                         hn::LoadDup128(dh, bases[k] + offset));
            };
            return hn::Combine(d, half(i + 4), half(i));
        }
    };
    const Doubles even = blocks(0), odd = blocks(1);
    first = hn::InterleaveLower(d, even, odd);
    second = hn::InterleaveUpper(d, even, odd);
}

// Corner of each lane's triangle: its height above the plane, and its coordinates in the plane.
struct CornerLanes {
    Doubles height, x, z;
};

HWY_INLINE CornerLanes choose(Mask mask, const CornerLanes& yes, const CornerLanes& no) {
    return {hn::IfThenElse(mask, yes.height, no.height), hn::IfThenElse(mask, yes.x, no.x),
            hn::IfThenElse(mask, yes.z, no.z)};
}

HWY_INLINE void load_corners(const TriangleCorners* const* triangles, const CutPlane& plane, CornerLanes (&corner)[3]) {
    const Tag d;
    const double* bases[max_lanes];
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) bases[i] = triangles[i]->y;
    Doubles unused;
    load_pairs(bases, 0, corner[0].height, corner[1].height);
    load_pairs(bases, 2, corner[2].height, corner[0].z);
    load_pairs(bases, 4, corner[1].z, corner[2].z);
    load_pairs(bases, 6, corner[0].x, corner[1].x);
    load_pairs(bases, 8, corner[2].x, unused);
    for (CornerLanes& c : corner)
        c.height = hn::Sub(hn::Sub(c.height, hn::Mul(hn::Set(d, plane.slope), c.z)), hn::Set(d, plane.row));
}

// Crossing, one per lane.
struct CrossingLanes {
    Doubles x, z, weight;
};

HWY_INLINE CrossingLanes cross_edge(const CornerLanes& lone, const CornerLanes& other, Mask upwards,
                                    const CutPlane& plane) {
    const Tag d;
    const CornerLanes low = choose(upwards, lone, other), high = choose(upwards, other, lone);
    const Doubles fraction = hn::Div(low.height, hn::Sub(low.height, high.height));
    const Doubles x = hn::Add(low.x, hn::Mul(fraction, hn::Sub(high.x, low.x)));
    const Doubles z = hn::Add(low.z, hn::Mul(fraction, hn::Sub(high.z, low.z)));
    return {hn::Add(x, hn::Set(d, plane.shift)), hn::Sub(z, hn::Set(d, plane.z0)),
            hn::IfThenElse(upwards, hn::Sub(hn::Set(d, 1.0), fraction), fraction)};
}

// TriangleCut, one per lane, and the bit mask of the lanes that the plane crosses.
struct CutLanes {
    CrossingLanes end0, end1;
    Mask lone_is_2, lone_is_1, upwards;
    std::uint64_t crossed;
};

HWY_INLINE CutLanes cut_lanes(const CornerLanes (&corner)[3], const CutPlane& plane) {
    const Tag d;
    const Doubles zero = hn::Zero(d);
    const Mask below0 = hn::Lt(corner[0].height, zero), below1 = hn::Lt(corner[1].height, zero),
               below2 = hn::Lt(corner[2].height, zero);
    const std::uint64_t crossed = bits_of(d, hn::Or(hn::Xor(below0, below1), hn::Xor(below1, below2)));
    const Mask lone_is_2 = hn::Not(hn::Xor(below0, below1)), lone_is_1 = hn::Not(hn::Xor(below0, below2));
    const CornerLanes lone = choose(lone_is_2, corner[2], choose(lone_is_1, corner[1], corner[0]));
    const CornerLanes after = choose(lone_is_2, corner[0], choose(lone_is_1, corner[2], corner[1]));
    const CornerLanes before = choose(lone_is_2, corner[1], choose(lone_is_1, corner[0], corner[2]));
    const Mask upwards = hn::Lt(lone.height, zero);
    const CornerLanes next = choose(upwards, before, after), last = choose(upwards, after, before);
    return {cross_edge(lone, next, upwards, plane),
            cross_edge(lone, last, upwards, plane),
            lone_is_2,
            lone_is_1,
            upwards,
            crossed};
}

// Vector of cuts in memory, for work that is done triangle by triangle.
struct StoredCuts {
    HWY_ALIGN float ends[max_lanes][4];  // x0, z0, dx, dz of SpanValues
    HWY_ALIGN float weights0[max_lanes], weights1[max_lanes], depths0[max_lanes], depths1[max_lanes];
    HWY_ALIGN std::int64_t lones[max_lanes], nexts[max_lanes];
};

HWY_INLINE void store_cuts(const CutLanes& cut, double depth_per_z, EpiSpan* spans, std::size_t count,
                           StoredCuts& stored) {
    const Tag d;
    const IndexTag di;
    const HalfTag df;
    const auto& [end0, end1, lone_is_2, lone_is_1, upwards, crossed] = cut;
    const auto x0 = hn::DemoteTo(df, end0.x), z0 = hn::DemoteTo(df, end0.z);
    const auto x1 = hn::DemoteTo(df, end1.x), z1 = hn::DemoteTo(df, end1.z);
    if (count == hn::Lanes(d)) {
        hn::StoreInterleaved4(x0, z0, x1, z1, df, &spans->x0);
    } else {
        hn::StoreInterleaved4(x0, z0, x1, z1, df, stored.ends[0]);
        std::memcpy(spans, stored.ends, count * sizeof(EpiSpan));
    }
    hn::StoreInterleaved4(x0, z0, hn::DemoteTo(df, hn::Sub(end1.x, end0.x)), hn::DemoteTo(df, hn::Sub(end1.z, end0.z)),
                          df, stored.ends[0]);
    const Doubles depth = hn::Set(d, depth_per_z);
    hn::Store(hn::DemoteTo(df, end0.weight), df, stored.weights0);
    hn::Store(hn::DemoteTo(df, end1.weight), df, stored.weights1);
    hn::Store(hn::DemoteTo(df, hn::Mul(end0.z, depth)), df, stored.depths0);
    hn::Store(hn::DemoteTo(df, hn::Mul(end1.z, depth)), df, stored.depths1);
    const auto corners = [&](std::int64_t if2, std::int64_t if1, std::int64_t if0) HWY_ATTR {
        return hn::IfThenElse(hn::RebindMask(di, cut.lone_is_2), hn::Set(di, if2),
                              hn::IfThenElse(hn::RebindMask(di, cut.lone_is_1), hn::Set(di, if1), hn::Set(di, if0)));
    };
    hn::Store(corners(2, 1, 0), di, stored.lones);
    hn::Store(hn::IfThenElse(hn::RebindMask(di, upwards), corners(1, 0, 2), corners(0, 2, 1)), di, stored.nexts);
}

HWY_INLINE void write_values(const StoredCuts& cuts, std::size_t i, const Rgb* radiance, SpanValues& span) {
    const hn::FixedTag<float, 4> d4;
    const Rgb &at_lone = radiance[cuts.lones[i]], &at_next = radiance[cuts.nexts[i]],
              &at_last = radiance[3 - cuts.lones[i] - cuts.nexts[i]];
    std::memcpy(&span.x0, cuts.ends[i], sizeof(cuts.ends[i]));
    const auto w0 = hn::Set(d4, cuts.weights0[i]), w1 = hn::Set(d4, cuts.weights1[i]), one = hn::Set(d4, 1.0f);
    const auto lone = hn::LoadU(d4, &at_lone.r);
    const auto value0 = hn::Add(hn::Mul(w0, lone), hn::Mul(hn::Sub(one, w0), hn::LoadU(d4, &at_next.r)));
    const auto value1 = hn::Add(hn::Mul(w1, lone), hn::Mul(hn::Sub(one, w1), hn::LoadU(d4, &at_last.r)));
    hn::StoreU(value0, d4, span.value0);
    hn::StoreU(hn::Sub(value1, value0), d4, span.difference);
    span.value0[3] = cuts.depths0[i];
    span.difference[3] = cuts.depths1[i] - cuts.depths0[i];
}

void SetUpSpans(const TriangleClusters& clusters, std::span<const std::uint32_t> slots, const CutPlane& plane,
                EpiSpan* spans, SpanValues* values, SpanOrigin* origins) {
    const std::size_t lanes = hn::Lanes(Tag());
    StoredCuts cuts;
    for (std::size_t begin = 0; begin < slots.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, slots.size() - begin);
        const TriangleCorners* triangles[max_lanes];
        for (std::size_t i = 0; i < lanes; ++i) triangles[i] = &clusters.corners[slots[begin + std::min(i, count - 1)]];
        CornerLanes corner[3];
        load_corners(triangles, plane, corner);
        const CutLanes cut = cut_lanes(corner, plane);
        store_cuts(cut, plane.depth_per_z, spans + begin, count, cuts);
        for (std::size_t i = 0; i < count; ++i) {
            if ((cut.crossed >> i & 1) == 0) {
                spans[begin + i] = empty_span;
                values[begin + i] = {};
                if (origins) origins[begin + i] = {};
                continue;
            }
            write_values(cuts, i, triangles[i]->radiance, values[begin + i]);
            if (origins)
                origins[begin + i] = {cuts.weights0[i], cuts.weights1[i], clusters.triangles[slots[begin + i]],
                                      static_cast<std::uint16_t>(cuts.lones[i]),
                                      static_cast<std::uint16_t>(cuts.nexts[i])};
        }
    }
}
#endif

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::render::epi {
HOGEL_DISPATCH(set_up_spans, SetUpSpans);
}  // namespace hogel::render::epi
