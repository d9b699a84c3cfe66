// SPDX-License-Identifier: Apache-2.0
// Vector versions of find_max_depths_plain, find_footprint_plain and cells_occlude_plain for every SIMD target.
#include <algorithm>
#include <array>
#include <cstdint>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/render/epi/hierarchical_z.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// find_four() needs vectors of four lanes.
void FindMaxDepths(const EpipolarPlane& plane) { find_max_depths_plain(plane); }
FootprintBounds FindFootprint(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0,
                              CellColumns* columns) {
    return find_footprint_plain(box, plane, shift, z0, columns);
}
bool CellsOcclude(const EpipolarPlane& plane, const BoxFootprint& box) { return cells_occlude_plain(plane, box); }
#else
using Tag = hn::CappedTag<std::uint32_t, directions_per_cell>;
using Depths = hn::Vec<Tag>;

// Returns the farthest depths of a cell, lane by lane.
HWY_INLINE Depths max_depth_lanes(const std::uint64_t* words) {
    const Tag d;
    const hn::RepartitionToWide<Tag> d64;
    Depths max_depth = hn::Zero(d);
    for (std::size_t i = 0; i < directions_per_cell; i += hn::Lanes(d)) {
        const auto low = hn::BitCast(d, hn::LoadU(d64, words + i));
        const auto high = hn::BitCast(d, hn::LoadU(d64, words + i + hn::Lanes(d64)));
        max_depth = hn::Max(max_depth, hn::ConcatOdd(d, high, low));
    }
    return max_depth;
}

// Computes the farthest depths of the cells in four columns that begin at these words.
HWY_INLINE void find_four(const std::uint64_t* const (&words)[4], std::uint32_t (&max_depths)[4]) {
    const Tag d;
    const hn::RepartitionToWide<Tag> d64;
    const hn::FixedTag<std::uint32_t, 4> d4;
    // In each block of four lanes, lane i holds column i.
    const auto pair = [&](std::size_t i) HWY_ATTR {
        const Depths a = max_depth_lanes(words[i]), b = max_depth_lanes(words[i + 1]);
        return hn::BitCast(d64, hn::Max(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b)));
    };
    const auto first = pair(0), last = pair(2);
    const Depths columns = hn::Max(hn::BitCast(d, hn::InterleaveLower(d64, first, last)),
                                   hn::BitCast(d, hn::InterleaveUpper(d64, first, last)));
    HWY_ALIGN std::uint32_t lanes[HWY_MAX_BYTES / 4];
    hn::Store(columns, d, lanes);
    auto max_depth = hn::Load(d4, lanes);
    for (std::size_t i = 4; i < hn::Lanes(d); i += 4) max_depth = hn::Max(max_depth, hn::Load(d4, lanes + i));
    hn::StoreU(max_depth, d4, max_depths);
}

void FindMaxDepths(const EpipolarPlane& plane) {
    DepthCells& cells = *plane.cells;
    cells.writes = 0;
    for (std::size_t column = 0; column < plane.columns; column += 4) {
        const std::size_t count = std::min<std::size_t>(4, plane.columns - column);
        const std::uint64_t* words[4];
        for (std::size_t i = 0; i < 4; ++i)
            words[i] = plane.words + (column + std::min(i, count - 1)) * plane.directions;
        std::uint32_t* max_depths = &cells.max_depth[column];
        for (std::size_t k = 0; k < plane.directions; k += directions_per_cell, max_depths += plane.columns) {
            std::uint32_t four[4];
            if (const std::size_t size = plane.directions - k; size >= directions_per_cell)
                find_four(words, four);
            else
                for (std::size_t i = 0; i < 4; ++i)
                    four[i] = static_cast<std::uint32_t>(*std::max_element(words[i], words[i] + size) >> 32);
            std::copy_n(four, count, max_depths);
            for (const std::uint64_t*& cell : words) cell += directions_per_cell;
        }
    }
}

// One row of cells per lane.
FootprintBounds FindFootprint(const ClusterBox& cluster, const EpipolarPlane& plane, double shift, double z0,
                              CellColumns* columns) {
    const hn::RebindToFloat<Tag> df;
    const hn::RebindToSigned<Tag> di;
    const hn::Rebind<std::uint16_t, Tag> d16;
    const auto n_first = static_cast<float>(plane.first_column), n_count = static_cast<float>(plane.columns);
    const auto first = hn::Set(df, n_first), last = hn::Set(df, n_first + n_count - 1), one = hn::Set(df, 1.0f);
    const auto K_last = hn::Set(df, plane.first_direction + static_cast<float>(plane.directions) - 1);
    const BoxBounds box(cluster, plane, shift, z0);
    const auto x_low = hn::Set(df, box.x_low), x_high = hn::Set(df, box.x_high), margin = hn::Set(df, box.margin);
    const auto z_low = hn::Set(df, box.z_low), z_high = hn::Set(df, box.z_high);
    auto max_columns = hn::Zero(di);
    const std::size_t rows = CellColumns::needed(plane.directions) * CellColumns::rows;
    for (std::size_t row = 0; row < rows; row += hn::Lanes(di)) {
        const auto Ka = hn::Add(hn::Set(df, plane.first_direction + static_cast<float>(row * directions_per_cell)),
                                hn::Mul(hn::Iota(df, 0), hn::Set(df, static_cast<float>(directions_per_cell))));
        const auto Kb = hn::Min(K_last, hn::Add(Ka, hn::Set(df, static_cast<float>(directions_per_cell - 1))));
        const auto a = hn::Mul(Ka, z_low), b = hn::Mul(Ka, z_high), c = hn::Mul(Kb, z_low), e = hn::Mul(Kb, z_high);
        const auto min_Kz = hn::Min(hn::Min(a, b), hn::Min(c, e)), max_Kz = hn::Max(hn::Max(a, b), hn::Max(c, e));
        const auto begin = hn::Max(first, hn::Ceil(hn::Sub(hn::Sub(x_low, max_Kz), margin)));
        const auto end = hn::Min(last, hn::Floor(hn::Add(hn::Sub(x_high, min_Kz), margin)));
        // No columns if the box is not visible, even if its bounds are infinite, or in rows after the last.
        const auto visible = hn::And(hn::Le(begin, end), hn::Le(Ka, K_last));
        const auto number = hn::ConvertTo(di, hn::IfThenElseZero(visible, hn::Add(hn::Sub(end, begin), one)));
        max_columns = hn::Max(max_columns, number);
        CellColumns& group = columns[row / CellColumns::rows];
        const auto offset = hn::ConvertTo(di, hn::IfThenElseZero(visible, hn::Sub(begin, first)));
        hn::StoreU(hn::DemoteTo(d16, offset), d16, group.first + row % CellColumns::rows);
        hn::StoreU(hn::DemoteTo(d16, number), d16, group.count + row % CellColumns::rows);
    }
    return {box.min_depth, static_cast<std::uint32_t>(hn::GetLane(hn::MaxOfLanes(di, max_columns)))};
}

constexpr auto lowest_bits = [] {
    std::array<std::uint64_t, directions_per_cell + 1> bits{};
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = (std::uint64_t{1} << i) - 1;
    return bits;
}();

// Returns the mask of the first `count` cells (at most a vector) that do not occlude objects at `min_depth` or behind.
HWY_INLINE hn::Mask<Tag> open_cells(const std::uint32_t* cells, std::size_t count, Depths min_depth) {
    const Tag d;
    const auto first = hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&lowest_bits[count]));
    return hn::AndNot(hn::Lt(hn::LoadU(d, cells), min_depth), first);
}

// Tests a vector of columns and four rows at a time, because a branch on a single row is unpredictable.
bool CellsOcclude(const EpipolarPlane& plane, const BoxFootprint& box) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d), rows = DepthCells::rows(plane.directions);
    const Depths min_depth = hn::Set(d, box.bounds.min_depth);
    const std::uint32_t* cells = plane.cells->max_depth.data();
    std::size_t row = 0;
    if (box.bounds.max_columns <= lanes)
        for (; row + 4 <= rows; row += 4, cells += 4 * plane.columns) {
            const CellColumns& columns = box.columns[row / CellColumns::rows];
            const std::uint16_t* first = columns.first + row % CellColumns::rows;
            const std::uint16_t* count = columns.count + row % CellColumns::rows;
            const auto open = [&](std::size_t i) HWY_ATTR {
                return open_cells(cells + i * plane.columns + first[i], count[i], min_depth);
            };
            if (!hn::AllFalse(d, hn::Or(hn::Or(open(0), open(1)), hn::Or(open(2), open(3))))) return false;
        }
    for (; row < rows; ++row, cells += plane.columns) {
        const CellColumns& columns = box.columns[row / CellColumns::rows];
        const std::uint32_t* in_row = cells + columns.first[row % CellColumns::rows];
        for (std::size_t rest = columns.count[row % CellColumns::rows]; rest != 0; rest -= std::min(rest, lanes)) {
            if (!hn::AllFalse(d, open_cells(in_row, std::min(rest, lanes), min_depth))) return false;
            in_row += lanes;
        }
    }
    return true;
}
#endif

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::render::epi {
HOGEL_DISPATCH(find_max_depths, FindMaxDepths);
HOGEL_DISPATCH(find_footprint, FindFootprint);
HOGEL_DISPATCH(cells_occlude, CellsOcclude);
}  // namespace hogel::render::epi
