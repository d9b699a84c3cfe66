// SPDX-License-Identifier: Apache-2.0
// The vector twin of epi_set_up.cpp, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi/setup_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "hogel/render/epi/lane_bits.h"
#include "hogel/render/epi/setup.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// A single lane holds no two numbers.
void SetUp(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlanePlace& plane,
           Strip* strips, StripShades* shades, StripOrigin* origins) {
    set_up_plain(clusters, places, plane, strips, shades, origins);
}
#else
#if HWY_HAVE_SCALABLE
using Tag = hn::FixedTag<double, 2>;
#else
using Tag = hn::ScalableTag<double>;
#endif
using IndexTag = hn::RebindToSigned<Tag>;
using HalfTag = hn::Rebind<float, Tag>;  // as many floats
using Doubles = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

constexpr std::size_t max_lanes = hn::MaxLanes(Tag());

// Two numbers that stand so far behind each of these places.
HWY_INLINE void load_pairs(const double* const* places, std::size_t behind, Doubles& first, Doubles& second) {
    const Tag d;
    // Of every other place, from this one on.
    const auto blocks = [&](std::size_t i) HWY_ATTR {
        if constexpr (max_lanes == 2) {
            return hn::LoadDup128(d, places[i] + behind);
        } else if constexpr (max_lanes == 4) {
            return hn::OddEvenBlocks(hn::LoadDup128(d, places[i + 2] + behind), hn::LoadDup128(d, places[i] + behind));
        } else {
            // Half by half, for the compiler, as load_blocks().
            const hn::Half<Tag> dh;
            const auto half = [&](std::size_t k) HWY_ATTR {
                return hn::OddEvenBlocks(hn::LoadDup128(dh, places[k + 2] + behind),
                                         hn::LoadDup128(dh, places[k] + behind));
            };
            return hn::Combine(d, half(i + 4), half(i));
        }
    };
    const Doubles even = blocks(0), odd = blocks(1);
    first = hn::InterleaveLower(d, even, odd);
    second = hn::InterleaveUpper(d, even, odd);
}

// A corner of each lane's triangle: its height above the plane, and its place in it.
struct Corner {
    Doubles height, x, z;
};

HWY_INLINE Corner choose(Mask mask, const Corner& yes, const Corner& no) {
    return {hn::IfThenElse(mask, yes.height, no.height), hn::IfThenElse(mask, yes.x, no.x),
            hn::IfThenElse(mask, yes.z, no.z)};
}

// As cut_triangle.
struct CutLanes {
    Doubles x, z, weight;
};

HWY_INLINE CutLanes cut_edge(const Corner& lone, const Corner& other, Mask upwards) {
    const Corner low = choose(upwards, lone, other), high = choose(upwards, other, lone);
    const Doubles part = hn::Div(low.height, hn::Sub(low.height, high.height));
    return {hn::Add(low.x, hn::Mul(part, hn::Sub(high.x, low.x))),
            hn::Add(low.z, hn::Mul(part, hn::Sub(high.z, low.z))),
            hn::IfThenElse(upwards, hn::Sub(hn::Set(Tag(), 1.0), part), part)};
}

void SetUp(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlanePlace& plane,
           Strip* strips, StripShades* shades, StripOrigin* origins) {
    const Tag d;
    const IndexTag di;
    const HalfTag df;
    const std::size_t lanes = hn::Lanes(d);
    HWY_ALIGN float ends[max_lanes][4], steps[max_lanes][4], weights0[max_lanes], weights1[max_lanes],
        depths0[max_lanes], depths1[max_lanes];
    HWY_ALIGN std::int64_t lones[max_lanes], nexts[max_lanes];
    for (std::size_t begin = 0; begin < places.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, places.size() - begin);
        const TriangleCorners* triangles[max_lanes];
        const double* numbers_of[max_lanes];
        for (std::size_t i = 0; i < lanes; ++i) {
            triangles[i] = &clusters.corners[places[begin + std::min(i, count - 1)]];
            numbers_of[i] = triangles[i]->y;
        }
        Corner corner[3];
        Doubles unused;
        load_pairs(numbers_of, 0, corner[0].height, corner[1].height);
        load_pairs(numbers_of, 2, corner[2].height, corner[0].z);
        load_pairs(numbers_of, 4, corner[1].z, corner[2].z);
        load_pairs(numbers_of, 6, corner[0].x, corner[1].x);
        load_pairs(numbers_of, 8, corner[2].x, unused);
        for (Corner& c : corner)
            c.height = hn::Sub(hn::Sub(c.height, hn::Mul(hn::Set(d, plane.slope), c.z)), hn::Set(d, plane.row));
        const Doubles zero = hn::Zero(d);
        const Mask below0 = hn::Lt(corner[0].height, zero), below1 = hn::Lt(corner[1].height, zero),
                   below2 = hn::Lt(corner[2].height, zero);
        const std::uint64_t crossed = bits_of(d, hn::Or(hn::Xor(below0, below1), hn::Xor(below1, below2)));
        const Mask alone2 = hn::Not(hn::Xor(below0, below1)), alone1 = hn::Not(hn::Xor(below0, below2));
        const Corner lone = choose(alone2, corner[2], choose(alone1, corner[1], corner[0]));
        const Corner after = choose(alone2, corner[0], choose(alone1, corner[2], corner[1]));
        const Corner before = choose(alone2, corner[1], choose(alone1, corner[0], corner[2]));
        const Mask upwards = hn::Lt(lone.height, zero);
        const Corner next = choose(upwards, before, after), last = choose(upwards, after, before);
        CutLanes end0 = cut_edge(lone, next, upwards), end1 = cut_edge(lone, last, upwards);
        for (CutLanes* end : {&end0, &end1}) {
            end->x = hn::Add(end->x, hn::Set(d, plane.shift));
            end->z = hn::Sub(end->z, hn::Set(d, plane.z0));
        }
        const auto x0 = hn::DemoteTo(df, end0.x), z0 = hn::DemoteTo(df, end0.z);
        const auto x1 = hn::DemoteTo(df, end1.x), z1 = hn::DemoteTo(df, end1.z);
        if (count == lanes) {
            hn::StoreInterleaved4(x0, z0, x1, z1, df, &strips[begin].x0);
        } else {
            hn::StoreInterleaved4(x0, z0, x1, z1, df, ends[0]);
            std::memcpy(strips + begin, ends, count * sizeof(Strip));
        }
        hn::StoreInterleaved4(x0, z0, hn::DemoteTo(df, hn::Sub(end1.x, end0.x)),
                              hn::DemoteTo(df, hn::Sub(end1.z, end0.z)), df, steps[0]);
        const Doubles depth = hn::Set(d, plane.depth);
        hn::Store(hn::DemoteTo(df, end0.weight), df, weights0);
        hn::Store(hn::DemoteTo(df, end1.weight), df, weights1);
        hn::Store(hn::DemoteTo(df, hn::Mul(end0.z, depth)), df, depths0);
        hn::Store(hn::DemoteTo(df, hn::Mul(end1.z, depth)), df, depths1);
        const auto numbers = [&](std::int64_t if2, std::int64_t if1, std::int64_t if0) HWY_ATTR {
            return hn::IfThenElse(hn::RebindMask(di, alone2), hn::Set(di, if2),
                                  hn::IfThenElse(hn::RebindMask(di, alone1), hn::Set(di, if1), hn::Set(di, if0)));
        };
        hn::Store(numbers(2, 1, 0), di, lones);
        hn::Store(hn::IfThenElse(hn::RebindMask(di, upwards), numbers(1, 0, 2), numbers(0, 2, 1)), di, nexts);

        for (std::size_t i = 0; i < count; ++i) {
            if ((crossed >> i & 1) == 0) {
                strips[begin + i] = nowhere;
                shades[begin + i] = {};
                if (origins) origins[begin + i] = {};
                continue;
            }
            const Rgb* radiance = triangles[i]->radiance;
            const Rgb &at_lone = radiance[lones[i]], &at_next = radiance[nexts[i]],
                      &at_last = radiance[3 - lones[i] - nexts[i]];
            StripShades& to = shades[begin + i];
            std::memcpy(&to.x0, steps[i], sizeof(steps[i]));
            const hn::FixedTag<float, 4> d4;
            const auto w0 = hn::Set(d4, weights0[i]), w1 = hn::Set(d4, weights1[i]), all = hn::Set(d4, 1.0f);
            const auto of_lone = hn::LoadU(d4, &at_lone.r);
            const auto value0 = hn::Add(hn::Mul(w0, of_lone), hn::Mul(hn::Sub(all, w0), hn::LoadU(d4, &at_next.r)));
            const auto value1 = hn::Add(hn::Mul(w1, of_lone), hn::Mul(hn::Sub(all, w1), hn::LoadU(d4, &at_last.r)));
            hn::StoreU(value0, d4, to.value0);
            hn::StoreU(hn::Sub(value1, value0), d4, to.difference);
            to.value0[3] = depths0[i];
            to.difference[3] = depths1[i] - depths0[i];
            if (origins)
                origins[begin + i] = {weights0[i], weights1[i], clusters.triangles[places[begin + i]],
                                      static_cast<std::uint16_t>(lones[i]), static_cast<std::uint16_t>(nexts[i])};
        }
    }
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::render::epi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::render::epi {

HWY_EXPORT(SetUp);

void set_up(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlanePlace& plane,
            Strip* strips, StripShades* shades, StripOrigin* origins) {
    HWY_DYNAMIC_DISPATCH(SetUp)(clusters, places, plane, strips, shades, origins);
}

}  // namespace hogel::render::epi
#endif
