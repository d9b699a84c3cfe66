// The vector twins of epi_set_up.cpp, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_set_up_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "hogel/render/epi_set_up_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<double>;
using IndexTag = hn::RebindToSigned<Tag>;
using HalfTag = hn::Rebind<float, Tag>;  // as many floats
using Doubles = hn::Vec<Tag>;
using Indices = hn::Vec<IndexTag>;
using Mask = hn::Mask<Tag>;

// The truth of up to 64 lanes as bits.
HWY_INLINE std::uint64_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask, bytes);
    std::uint64_t bits = 0;
    for (std::size_t byte = 0; 8 * byte < hn::Lanes(Tag()); ++byte) bits |= std::uint64_t{bytes[byte]} << 8 * byte;
    return bits;
}

void ClustersCrossed(const ClusterBounds& bounds, const PlaneRays& rays, std::vector<std::uint32_t>& crossed) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d);
    const Doubles row = hn::Set(d, rays.row), slope = hn::Set(d, rays.slope), shift = hn::Set(d, rays.shift),
                  z0 = hn::Set(d, rays.z0), zero = hn::Zero(d);
    const Doubles K_first = hn::Set(d, rays.K_first), K_last = hn::Set(d, rays.K_last);
    const Doubles n_first = hn::Set(d, rays.n_first), n_last = hn::Set(d, rays.n_last);
    for (std::size_t i = 0; i < bounds.size(); i += lanes) {
        const Doubles z_low = hn::Load(d, &bounds.z_low[i]), z_high = hn::Load(d, &bounds.z_high[i]);
        const Doubles a = hn::Mul(slope, z_low), b = hn::Mul(slope, z_high);
        const Doubles from = hn::Sub(hn::Sub(hn::Load(d, &bounds.y_low[i]), hn::Max(a, b)), row);
        const Doubles to = hn::Sub(hn::Sub(hn::Load(d, &bounds.y_high[i]), hn::Min(a, b)), row);
        const Mask meets = hn::And(hn::Lt(from, zero), hn::Ge(to, zero));
        if (hn::AllFalse(d, meets)) continue;
        const Doubles near = hn::Sub(z_low, z0), far = hn::Sub(z_high, z0);
        const Doubles c[] = {hn::Mul(K_first, near), hn::Mul(K_last, near), hn::Mul(K_first, far),
                             hn::Mul(K_last, far)};
        const Doubles least = hn::Min(hn::Min(c[0], c[1]), hn::Min(c[2], c[3]));
        const Doubles most = hn::Max(hn::Max(c[0], c[1]), hn::Max(c[2], c[3]));
        const Doubles x_low = hn::Load(d, &bounds.x_low[i]), x_high = hn::Load(d, &bounds.x_high[i]);
        const Doubles n_low = hn::Sub(hn::Add(x_low, shift), most), n_high = hn::Sub(hn::Add(x_high, shift), least);
        const Doubles reach = hn::Add(hn::Max(hn::Abs(x_low), hn::Abs(x_high)), hn::Max(hn::Abs(least), hn::Abs(most)));
        const Doubles margin = hn::Add(hn::Set(d, 1.0), hn::Mul(hn::Set(d, 1e-6), reach));
        const Mask sees = hn::And(hn::Le(hn::Sub(n_low, margin), n_last), hn::Ge(hn::Add(n_high, margin), n_first));
        for (std::uint64_t rest = bits_of(hn::And(meets, sees)); rest != 0; rest &= rest - 1)
            crossed.push_back(static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(std::countr_zero(rest)));
    }
}

std::uint64_t Crossing(const ClusterCorners& corners, double row, double slope) {
    const Tag d;
    const Doubles rows = hn::Set(d, row), slopes = hn::Set(d, slope), zero = hn::Zero(d);
    std::uint64_t crossed = 0;
    for (std::size_t i = 0; i < cluster_size; i += hn::Lanes(d)) {
        const auto below = [&](int corner) HWY_ATTR {
            const Doubles y = hn::Load(d, corners.y[corner] + i), z = hn::Load(d, corners.z[corner] + i);
            return hn::Lt(hn::Sub(hn::Sub(y, hn::Mul(slopes, z)), rows), zero);
        };
        const Mask first = below(0), second = below(1), third = below(2);
        crossed |= bits_of(hn::Or(hn::Xor(first, second), hn::Xor(second, third))) << i;
    }
    return crossed;
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

void SetUp(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlaneRays& rays,
           Strip* strips, StripShades* shades, StripOrigin* origins) {
    const Tag d;
    const IndexTag di;
    const HalfTag df;
    const hn::Rebind<std::uint32_t, Tag> du;
    const std::size_t lanes = hn::Lanes(d);
    constexpr std::size_t most_lanes = HWY_MAX_BYTES / 8;
    // In doubles.
    constexpr int per_cluster = sizeof(ClusterCorners) / sizeof(double), log2_size = std::countr_zero(cluster_size),
                  log2_triangle = 3;
    static_assert(sizeof(TriangleCorners) == sizeof(double) << log2_triangle);
    const double* y = clusters.corners.front().y[0];
    const double* z = clusters.corners.front().z[0];
    const double* x = clusters.others.front().x;
    HWY_ALIGN std::uint32_t several[most_lanes];
    HWY_ALIGN float ends[most_lanes][4], steps[most_lanes][4], weights0[most_lanes], weights1[most_lanes],
        depths0[most_lanes], depths1[most_lanes];
    HWY_ALIGN std::int64_t lones[most_lanes], nexts[most_lanes];
    for (std::size_t begin = 0; begin < places.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, places.size() - begin);
        for (std::size_t i = 0; i < lanes; ++i) several[i] = places[begin + std::min(i, count - 1)];
        const Indices place = hn::BitCast(di, hn::PromoteTo(hn::RebindToUnsigned<IndexTag>(), hn::Load(du, several)));
        const Indices in_cluster = hn::Add(hn::Mul(hn::ShiftRight<log2_size>(place), hn::Set(di, per_cluster)),
                                           hn::And(place, hn::Set(di, cluster_size - 1)));
        const Indices in_others = hn::ShiftLeft<log2_triangle>(place);
        Corner corner[3];
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i].x = hn::GatherIndex(d, x + i, in_others);
            corner[i].z = hn::GatherIndex(d, z + i * cluster_size, in_cluster);
            corner[i].height = hn::Sub(hn::Sub(hn::GatherIndex(d, y + i * cluster_size, in_cluster),
                                               hn::Mul(hn::Set(d, rays.slope), corner[i].z)),
                                       hn::Set(d, rays.row));
        }
        const Doubles zero = hn::Zero(d);
        const Mask below0 = hn::Lt(corner[0].height, zero), below1 = hn::Lt(corner[1].height, zero),
                   below2 = hn::Lt(corner[2].height, zero);
        const Mask alone2 = hn::Not(hn::Xor(below0, below1)), alone1 = hn::Not(hn::Xor(below0, below2));
        const Corner lone = choose(alone2, corner[2], choose(alone1, corner[1], corner[0]));
        const Corner after = choose(alone2, corner[0], choose(alone1, corner[2], corner[1]));
        const Corner before = choose(alone2, corner[1], choose(alone1, corner[0], corner[2]));
        const Mask upwards = hn::Lt(lone.height, zero);
        const Corner next = choose(upwards, before, after), last = choose(upwards, after, before);
        CutLanes end0 = cut_edge(lone, next, upwards), end1 = cut_edge(lone, last, upwards);
        for (CutLanes* end : {&end0, &end1}) {
            end->x = hn::Add(end->x, hn::Set(d, rays.shift));
            end->z = hn::Sub(end->z, hn::Set(d, rays.z0));
        }
        const auto x0 = hn::DemoteTo(df, end0.x), z0 = hn::DemoteTo(df, end0.z);
        hn::StoreInterleaved4(x0, z0, hn::DemoteTo(df, end1.x), hn::DemoteTo(df, end1.z), df, ends[0]);
        hn::StoreInterleaved4(x0, z0, hn::DemoteTo(df, hn::Sub(end1.x, end0.x)),
                              hn::DemoteTo(df, hn::Sub(end1.z, end0.z)), df, steps[0]);
        const Doubles depth = hn::Set(d, rays.depth);
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

        std::memcpy(strips + begin, ends, count * sizeof(Strip));
        for (std::size_t i = 0; i < count; ++i) {
            const Rgb* radiance = clusters.others[several[i]].radiance;
            const Rgb &at_lone = radiance[lones[i]], &at_next = radiance[nexts[i]],
                      &at_last = radiance[3 - lones[i] - nexts[i]];
            StripShades& to = shades[begin + i];
            std::memcpy(&to.x0, steps[i], sizeof(steps[i]));
#if HWY_TARGET == HWY_SCALAR
            const float w0 = weights0[i], w1 = weights1[i];
            const Rgb value0 = w0 * at_lone + (1 - w0) * at_next;
            const Rgb value1 = w1 * at_lone + (1 - w1) * at_last;
            const Rgb difference{value1.r - value0.r, value1.g - value0.g, value1.b - value0.b};
            std::memcpy(to.value0, &value0, sizeof(Rgb));
            std::memcpy(to.difference, &difference, sizeof(Rgb));
#else
            const hn::FixedTag<float, 4> d4;
            const auto w0 = hn::Set(d4, weights0[i]), w1 = hn::Set(d4, weights1[i]), all = hn::Set(d4, 1.0f);
            const auto of_lone = hn::LoadU(d4, &at_lone.r);
            const auto value0 = hn::Add(hn::Mul(w0, of_lone), hn::Mul(hn::Sub(all, w0), hn::LoadU(d4, &at_next.r)));
            const auto value1 = hn::Add(hn::Mul(w1, of_lone), hn::Mul(hn::Sub(all, w1), hn::LoadU(d4, &at_last.r)));
            hn::StoreU(value0, d4, to.value0);
            hn::StoreU(hn::Sub(value1, value0), d4, to.difference);
#endif
            to.value0[3] = depths0[i];
            to.difference[3] = depths1[i] - depths0[i];
            if (origins)
                origins[begin + i] = {weights0[i], weights1[i], clusters.triangles[several[i]],
                                      static_cast<std::uint16_t>(lones[i]), static_cast<std::uint16_t>(nexts[i])};
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(ClustersCrossed);
HWY_EXPORT(Crossing);
HWY_EXPORT(SetUp);

void clusters_crossed(const ClusterBounds& bounds, const PlaneRays& rays, std::vector<std::uint32_t>& crossed) {
    HWY_DYNAMIC_DISPATCH(ClustersCrossed)(bounds, rays, crossed);
}

std::uint64_t crossing(const ClusterCorners& corners, double row, double slope) {
    return HWY_DYNAMIC_DISPATCH(Crossing)(corners, row, slope);
}

void set_up(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlaneRays& rays,
            Strip* strips, StripShades* shades, StripOrigin* origins) {
    HWY_DYNAMIC_DISPATCH(SetUp)(clusters, places, rays, strips, shades, origins);
}

}  // namespace hogel
#endif
