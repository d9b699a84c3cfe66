// SPDX-License-Identifier: Apache-2.0
// The vector twin of find_crossings_plain in epi_crossings.cpp, compiled for every instruction set and chosen when
// first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi/crossings_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "hogel/render/epi/crossings.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, cluster_size>;
using IntTag = hn::RebindToSigned<FloatTag>;
using ByteTag = hn::CappedTag<std::uint8_t, cluster_size>;
using Floats = hn::Vec<FloatTag>;

// Heights are asked for so many clusters ahead.
constexpr std::size_t clusters_ahead = 3;

static_assert(RowRays::max_planes <= 256, "a plane's number fits a byte");

HWY_INLINE Floats steps_of(const std::uint16_t* steps) {
    const FloatTag d;
    const IntTag di;
    return hn::ConvertTo(d, hn::PromoteTo(di, hn::Load(hn::Rebind<std::uint16_t, FloatTag>(), steps)));
}

// The planes from `begin` to `end` of each triangle, the last below the first where there are none; and from the least
// to the greatest of them.
struct PlanesOfTriangles {
    HWY_ALIGN std::uint8_t begin[cluster_size], end[cluster_size];
    std::size_t least, greatest;
};

HWY_INLINE void find_planes(const ClusterHeights& heights, const HeightScale& scale, std::size_t planes,
                            PlanesOfTriangles& to) {
    const FloatTag d;
    const IntTag di;
    const hn::Rebind<std::uint8_t, FloatTag> d8;
    const Floats zero = hn::Zero(d), last = hn::Set(d, static_cast<float>(planes - 1));
    const Floats highest = hn::Set(d, static_cast<float>(RowRays::max_planes - 1));
    Floats least = highest, greatest = zero;
    for (std::size_t i = 0; i < cluster_size; i += hn::Lanes(d)) {
        Floats y[3], z[3], R[3], at[3];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Floats y_steps = steps_of(heights.y[corner] + i), z_steps = steps_of(heights.z[corner] + i);
            y[corner] = hn::Add(hn::Set(d, scale.y), hn::Mul(hn::Set(d, scale.y_step), y_steps));
            z[corner] = hn::Add(hn::Set(d, scale.z), hn::Mul(hn::Set(d, scale.z_step), z_steps));
            R[corner] = hn::Div(hn::Set(d, scale.per_slope), z[corner]);
            at[corner] = hn::Add(hn::Mul(y[corner], R[corner]), hn::Set(d, scale.first));
        }
        const Floats R_low = hn::Min(hn::Min(R[0], R[1]), R[2]), R_high = hn::Max(hn::Max(R[0], R[1]), R[2]);
        const Floats low = hn::Min(hn::Min(at[0], at[1]), at[2]), high = hn::Max(hn::Max(at[0], at[1]), at[2]);
        const Floats steepest = hn::Max(hn::Neg(R_low), R_high);
        const auto known =
            hn::And(hn::Lt(steepest, hn::Set(d, scale.most)), hn::Or(hn::Gt(R_low, zero), hn::Lt(R_high, zero)));
        const Floats margin = hn::Add(hn::Mul(hn::Set(d, scale.error), steepest), hn::Set(d, scale.rounding));
        const Floats from = hn::IfThenElseZero(known, hn::Max(zero, hn::Ceil(hn::Sub(low, margin))));
        const Floats upto = hn::IfThenElse(known, hn::Min(last, hn::Floor(hn::Add(high, margin))), last);
        auto some = hn::Le(from, upto);
        if (!hn::AllTrue(d, known)) {
            const Floats y_low = hn::Min(hn::Min(y[0], y[1]), y[2]), y_high = hn::Max(hn::Max(y[0], y[1]), y[2]);
            const Floats far = hn::Max(hn::Max(hn::Abs(z[0]), hn::Abs(z[1])), hn::Abs(z[2]));
            const Floats reach = hn::Add(hn::Mul(hn::Set(d, scale.steepest), far), hn::Set(d, scale.error));
            const auto beyond = hn::Or(hn::Gt(y_low, reach), hn::Lt(y_high, hn::Neg(reach)));
            some = hn::And(some, hn::Or(known, hn::Not(beyond)));
        }
        const Floats begin = hn::IfThenElse(some, from, highest), end = hn::IfThenElseZero(some, upto);
        least = hn::Min(least, begin);
        greatest = hn::Max(greatest, end);
        hn::StoreU(hn::DemoteTo(d8, hn::ConvertTo(di, begin)), d8, to.begin + i);
        hn::StoreU(hn::DemoteTo(d8, hn::ConvertTo(di, end)), d8, to.end + i);
    }
    to.least = static_cast<std::size_t>(hn::GetLane(hn::MinOfLanes(d, least)));
    to.greatest = static_cast<std::size_t>(hn::GetLane(hn::MaxOfLanes(d, greatest)));
}

HWY_INLINE std::uint64_t triangles_of(const PlanesOfTriangles& planes, std::size_t plane) {
    const ByteTag d;
    const auto number = hn::Set(d, static_cast<std::uint8_t>(plane));
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < cluster_size; i += hn::Lanes(d)) {
        const auto begin = hn::Load(d, planes.begin + i), end = hn::Load(d, planes.end + i);
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(d, hn::Not(hn::Or(hn::Gt(begin, number), hn::Gt(number, end))), bytes);
        std::uint64_t bits;
        std::memcpy(&bits, bytes, sizeof(bits));
        triangles |= bits << i;
    }
    return triangles;
}

void FindCrossings(const TriangleClusters& clusters, const RowRays& rays, Crossings& crossings) {
    crossings.resize(rays.planes);
    for (std::vector<Crossing>& of_plane : crossings) of_plane.clear();
    PlanesOfTriangles planes;
    for (std::uint32_t cluster = 0; cluster < clusters.heights.size(); ++cluster) {
        const auto* ahead = reinterpret_cast<const char*>(
            &clusters.heights[std::min<std::size_t>(cluster + clusters_ahead, clusters.heights.size() - 1)]);
        for (std::size_t byte = 0; byte < sizeof(ClusterHeights); byte += 64) __builtin_prefetch(ahead + byte);
        const ClusterBox& box = clusters.boxes[cluster];
        if (!may_meet(box, rays)) continue;
        find_planes(clusters.heights[cluster], HeightScale(box, rays), rays.planes, planes);
        const std::uint64_t filled = clusters.filled(cluster);
        for (std::size_t plane = planes.least; plane <= planes.greatest; ++plane)
            if (const std::uint64_t triangles = triangles_of(planes, plane) & filled; triangles != 0)
                crossings[plane].push_back({triangles, cluster});
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel::render::epi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::render::epi {

HWY_EXPORT(FindCrossings);

void find_crossings(const TriangleClusters& clusters, const RowRays& rays, Crossings& crossings) {
    HWY_DYNAMIC_DISPATCH(FindCrossings)(clusters, rays, crossings);
}

}  // namespace hogel::render::epi
#endif
