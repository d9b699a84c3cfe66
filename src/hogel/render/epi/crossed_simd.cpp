// SPDX-License-Identifier: Apache-2.0
// Vector version of find_crossed_plain in crossed.cpp for every SIMD target.
#include <algorithm>
#include <cstring>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/render/epi/crossed.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, cluster_size>;
using IntTag = hn::RebindToSigned<FloatTag>;
using ByteTag = hn::CappedTag<std::uint8_t, cluster_size>;
using Floats = hn::Vec<FloatTag>;

// Prefetch distance of heights, in clusters.
constexpr std::size_t prefetch_distance = 3;

static_assert(RowPlanes::max_planes <= 256, "a plane index fits in a byte");

HWY_INLINE Floats load_steps(const std::uint16_t* steps) {
    const FloatTag d;
    const IntTag di;
    return hn::ConvertTo(d, hn::PromoteTo(di, hn::Load(hn::Rebind<std::uint16_t, FloatTag>(), steps)));
}

// Planes `begin` to `end` that may cross each triangle (none if end < begin), and their common range.
struct PlaneRanges {
    HWY_ALIGN std::uint8_t begin[cluster_size], end[cluster_size];
    std::size_t min_plane, max_plane;
};

HWY_INLINE void find_planes(const ClusterHeights& heights, const HeightScale& scale, std::size_t planes,
                            PlaneRanges& ranges) {
    const FloatTag d;
    const IntTag di;
    const hn::Rebind<std::uint8_t, FloatTag> d8;
    const Floats zero = hn::Zero(d), last = hn::Set(d, static_cast<float>(planes - 1));
    const Floats none = hn::Set(d, static_cast<float>(RowPlanes::max_planes - 1));
    Floats min_plane = none, max_plane = zero;
    for (std::size_t i = 0; i < cluster_size; i += hn::Lanes(d)) {
        Floats y[3], z[3], R[3], plane_index[3];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Floats y_steps = load_steps(heights.y[corner] + i), z_steps = load_steps(heights.z[corner] + i);
            y[corner] = hn::Add(hn::Set(d, scale.y), hn::Mul(hn::Set(d, scale.y_step), y_steps));
            z[corner] = hn::Add(hn::Set(d, scale.z), hn::Mul(hn::Set(d, scale.z_step), z_steps));
            R[corner] = hn::Div(hn::Set(d, scale.per_slope), z[corner]);
            plane_index[corner] = hn::Add(hn::Mul(y[corner], R[corner]), hn::Set(d, scale.first));
        }
        const Floats R_low = hn::Min(hn::Min(R[0], R[1]), R[2]), R_high = hn::Max(hn::Max(R[0], R[1]), R[2]);
        const Floats low = hn::Min(hn::Min(plane_index[0], plane_index[1]), plane_index[2]),
                     high = hn::Max(hn::Max(plane_index[0], plane_index[1]), plane_index[2]);
        const Floats max_R = hn::Max(hn::Neg(R_low), R_high);
        const auto bounded =
            hn::And(hn::Lt(max_R, hn::Set(d, scale.max_R)), hn::Or(hn::Gt(R_low, zero), hn::Lt(R_high, zero)));
        const Floats margin = hn::Add(hn::Mul(hn::Set(d, scale.error), max_R), hn::Set(d, scale.rounding));
        const Floats first = hn::IfThenElseZero(bounded, hn::Max(zero, hn::Ceil(hn::Sub(low, margin))));
        const Floats last_plane = hn::IfThenElse(bounded, hn::Min(last, hn::Floor(hn::Add(high, margin))), last);
        auto nonempty = hn::Le(first, last_plane);
        if (!hn::AllTrue(d, bounded)) {
            const Floats y_low = hn::Min(hn::Min(y[0], y[1]), y[2]), y_high = hn::Max(hn::Max(y[0], y[1]), y[2]);
            const Floats max_z = hn::Max(hn::Max(hn::Abs(z[0]), hn::Abs(z[1])), hn::Abs(z[2]));
            const Floats max_y = hn::Add(hn::Mul(hn::Set(d, scale.max_slope), max_z), hn::Set(d, scale.error));
            const auto outside = hn::Or(hn::Gt(y_low, max_y), hn::Lt(y_high, hn::Neg(max_y)));
            nonempty = hn::And(nonempty, hn::Or(bounded, hn::Not(outside)));
        }
        const Floats begin = hn::IfThenElse(nonempty, first, none), end = hn::IfThenElseZero(nonempty, last_plane);
        min_plane = hn::Min(min_plane, begin);
        max_plane = hn::Max(max_plane, end);
        hn::StoreU(hn::DemoteTo(d8, hn::ConvertTo(di, begin)), d8, ranges.begin + i);
        hn::StoreU(hn::DemoteTo(d8, hn::ConvertTo(di, end)), d8, ranges.end + i);
    }
    ranges.min_plane = static_cast<std::size_t>(hn::GetLane(hn::MinOfLanes(d, min_plane)));
    ranges.max_plane = static_cast<std::size_t>(hn::GetLane(hn::MaxOfLanes(d, max_plane)));
}

HWY_INLINE std::uint64_t triangles_in(const PlaneRanges& ranges, std::size_t plane) {
    const ByteTag d;
    const auto number = hn::Set(d, static_cast<std::uint8_t>(plane));
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < cluster_size; i += hn::Lanes(d)) {
        const auto begin = hn::Load(d, ranges.begin + i), end = hn::Load(d, ranges.end + i);
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(d, hn::Not(hn::Or(hn::Gt(begin, number), hn::Gt(number, end))), bytes);
        std::uint64_t bits;
        std::memcpy(&bits, bytes, sizeof(bits));
        triangles |= bits << i;
    }
    return triangles;
}

void FindCrossed(const TriangleClusters& clusters, const RowPlanes& planes, CrossedByPlane& crossed) {
    crossed.resize(planes.count);
    for (std::vector<CrossedTriangles>& by_plane : crossed) by_plane.clear();
    PlaneRanges ranges;
    for (std::uint32_t cluster = 0; cluster < clusters.heights.size(); ++cluster) {
        const auto* next_heights = reinterpret_cast<const char*>(
            &clusters.heights[std::min<std::size_t>(cluster + prefetch_distance, clusters.heights.size() - 1)]);
        for (std::size_t byte = 0; byte < sizeof(ClusterHeights); byte += 64) __builtin_prefetch(next_heights + byte);
        const ClusterBox& box = clusters.boxes[cluster];
        if (!may_show(box, planes)) continue;
        find_planes(clusters.heights[cluster], HeightScale(box, planes), planes.count, ranges);
        const std::uint64_t occupied = clusters.occupied(cluster);
        for (std::size_t plane = ranges.min_plane; plane <= ranges.max_plane; ++plane)
            if (const std::uint64_t triangles = triangles_in(ranges, plane) & occupied; triangles != 0)
                crossed[plane].push_back({triangles, cluster});
    }
}

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::render::epi {
HOGEL_DISPATCH(find_crossed, FindCrossed);
}  // namespace hogel::render::epi
