// SPDX-License-Identifier: Apache-2.0
// The vector twins of find_farthest_plain in epi_kernels.cpp and of see_box_plain and cells_hide_plain in
// epi_occlusion.cpp, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi/occlusion_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "hogel/render/epi/occlusion.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// A single lane holds no four columns.
void FindFarthest(const EpipolarPlane& plane) { find_farthest_plain(plane); }
BoxDepth SeeBox(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0, CellColumns* columns) {
    return see_box_plain(box, plane, shift, z0, columns);
}
bool CellsHide(const EpipolarPlane& plane, const SeenBox& box) { return cells_hide_plain(plane, box); }
#else
using Tag = hn::CappedTag<std::uint32_t, cell_directions>;
using Depths = hn::Vec<Tag>;

// The greatest depths of the lanes of a cell's words.
HWY_INLINE Depths farthest_lanes(const std::uint64_t* words) {
    const Tag d;
    const hn::RepartitionToWide<Tag> d64;
    Depths most = hn::Zero(d);
    for (std::size_t i = 0; i < cell_directions; i += hn::Lanes(d)) {
        const auto low = hn::BitCast(d, hn::LoadU(d64, words + i));
        const auto high = hn::BitCast(d, hn::LoadU(d64, words + i + hn::Lanes(d64)));
        most = hn::Max(most, hn::ConcatOdd(d, high, low));
    }
    return most;
}

// Of four columns' cells.
HWY_INLINE void find_four(const std::uint64_t* const (&words)[4], std::uint32_t (&farthest)[4]) {
    const Tag d;
    const hn::RepartitionToWide<Tag> d64;
    const hn::FixedTag<std::uint32_t, 4> d4;
    // Within blocks of four lanes every lane becomes one of the columns.
    const auto pair = [&](std::size_t i) HWY_ATTR {
        const Depths a = farthest_lanes(words[i]), b = farthest_lanes(words[i + 1]);
        return hn::BitCast(d64, hn::Max(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b)));
    };
    const auto first = pair(0), last = pair(2);
    const Depths all = hn::Max(hn::BitCast(d, hn::InterleaveLower(d64, first, last)),
                               hn::BitCast(d, hn::InterleaveUpper(d64, first, last)));
    HWY_ALIGN std::uint32_t lanes[HWY_MAX_BYTES / 4];
    hn::Store(all, d, lanes);
    auto most = hn::Load(d4, lanes);
    for (std::size_t i = 4; i < hn::Lanes(d); i += 4) most = hn::Max(most, hn::Load(d4, lanes + i));
    hn::StoreU(most, d4, farthest);
}

void FindFarthest(const EpipolarPlane& plane) {
    PlaneCells& cells = *plane.cells;
    cells.drawn = 0;
    for (std::size_t column = 0; column < plane.columns; column += 4) {
        const std::size_t count = std::min<std::size_t>(4, plane.columns - column);
        const std::uint64_t* words[4];
        for (std::size_t i = 0; i < 4; ++i)
            words[i] = plane.words + (column + std::min(i, count - 1)) * plane.directions;
        std::uint32_t* farthest = &cells.farthest[column];
        for (std::size_t k = 0; k < plane.directions; k += cell_directions, farthest += plane.columns) {
            std::uint32_t four[4];
            if (const std::size_t size = plane.directions - k; size >= cell_directions)
                find_four(words, four);
            else
                for (std::size_t i = 0; i < 4; ++i)
                    four[i] = static_cast<std::uint32_t>(*std::max_element(words[i], words[i] + size) >> 32);
            std::copy_n(four, count, farthest);
            for (const std::uint64_t*& of_column : words) of_column += cell_directions;
        }
    }
}

// A row of cells a lane.
BoxDepth SeeBox(const ClusterBox& cluster, const EpipolarPlane& plane, double shift, double z0, CellColumns* columns) {
    const hn::RebindToFloat<Tag> df;
    const hn::RebindToSigned<Tag> di;
    const hn::Rebind<std::uint16_t, Tag> d16;
    const auto n_first = static_cast<float>(plane.first_column), n_count = static_cast<float>(plane.columns);
    const auto first = hn::Set(df, n_first), last = hn::Set(df, n_first + n_count - 1), one = hn::Set(df, 1.0f);
    const auto K_last = hn::Set(df, plane.first_direction + static_cast<float>(plane.directions) - 1);
    const BoxBounds box(cluster, plane, shift, z0);
    const auto x_low = hn::Set(df, box.x_low), x_high = hn::Set(df, box.x_high), margin = hn::Set(df, box.margin);
    const auto z_low = hn::Set(df, box.z_low), z_high = hn::Set(df, box.z_high);
    auto widest = hn::Zero(di);
    const std::size_t rows = CellColumns::lines(plane.directions) * CellColumns::rows;
    for (std::size_t row = 0; row < rows; row += hn::Lanes(di)) {
        const auto Ka = hn::Add(hn::Set(df, plane.first_direction + static_cast<float>(row * cell_directions)),
                                hn::Mul(hn::Iota(df, 0), hn::Set(df, static_cast<float>(cell_directions))));
        const auto Kb = hn::Min(K_last, hn::Add(Ka, hn::Set(df, static_cast<float>(cell_directions - 1))));
        const auto a = hn::Mul(Ka, z_low), b = hn::Mul(Ka, z_high), c = hn::Mul(Kb, z_low), e = hn::Mul(Kb, z_high);
        const auto least = hn::Min(hn::Min(a, b), hn::Min(c, e)), most = hn::Max(hn::Max(a, b), hn::Max(c, e));
        const auto begin = hn::Max(first, hn::Ceil(hn::Sub(hn::Sub(x_low, most), margin)));
        const auto end = hn::Min(last, hn::Floor(hn::Add(hn::Sub(x_high, least), margin)));
        // None where the box is not seen, however far away that is, and none of rows that are not there.
        const auto seen = hn::And(hn::Le(begin, end), hn::Le(Ka, K_last));
        const auto number = hn::ConvertTo(di, hn::IfThenElseZero(seen, hn::Add(hn::Sub(end, begin), one)));
        widest = hn::Max(widest, number);
        CellColumns& line = columns[row / CellColumns::rows];
        const auto from = hn::ConvertTo(di, hn::IfThenElseZero(seen, hn::Sub(begin, first)));
        hn::StoreU(hn::DemoteTo(d16, from), d16, line.first + row % CellColumns::rows);
        hn::StoreU(hn::DemoteTo(d16, number), d16, line.count + row % CellColumns::rows);
    }
    return {box.nearest, static_cast<std::uint32_t>(hn::GetLane(hn::MaxOfLanes(di, widest)))};
}

// Numbers of which the lowest bits are set.
constexpr auto lowest_bits = [] {
    std::array<std::uint64_t, cell_directions + 1> bits{};
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = (std::uint64_t{1} << i) - 1;
    return bits;
}();

// The first cells, no more than a vector of them, that do not hide what is no nearer.
HWY_INLINE hn::Mask<Tag> open_cells(const std::uint32_t* cells, std::size_t count, Depths nearest) {
    const Tag d;
    const auto first = hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&lowest_bits[count]));
    return hn::AndNot(hn::Lt(hn::LoadU(d, cells), nearest), first);
}

// A vector of columns, four rows at a time, for what is found in one is not to be predicted.
bool CellsHide(const EpipolarPlane& plane, const SeenBox& box) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d), rows = PlaneCells::rows(plane.directions);
    const Depths nearest = hn::Set(d, box.depth.nearest);
    const std::uint32_t* cells = plane.cells->farthest.data();
    std::size_t row = 0;
    if (box.depth.widest <= lanes)
        for (; row + 4 <= rows; row += 4, cells += 4 * plane.columns) {
            const CellColumns& line = box.columns[row / CellColumns::rows];
            const std::uint16_t* first = line.first + row % CellColumns::rows;
            const std::uint16_t* count = line.count + row % CellColumns::rows;
            const auto open = [&](std::size_t i) HWY_ATTR {
                return open_cells(cells + i * plane.columns + first[i], count[i], nearest);
            };
            if (!hn::AllFalse(d, hn::Or(hn::Or(open(0), open(1)), hn::Or(open(2), open(3))))) return false;
        }
    for (; row < rows; ++row, cells += plane.columns) {
        const CellColumns& line = box.columns[row / CellColumns::rows];
        const std::uint32_t* of_row = cells + line.first[row % CellColumns::rows];
        for (std::size_t rest = line.count[row % CellColumns::rows]; rest != 0; rest -= std::min(rest, lanes)) {
            if (!hn::AllFalse(d, open_cells(of_row, std::min(rest, lanes), nearest))) return false;
            of_row += lanes;
        }
    }
    return true;
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::render::epi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::render::epi {

HWY_EXPORT(FindFarthest);
HWY_EXPORT(SeeBox);
HWY_EXPORT(CellsHide);

void find_farthest(const EpipolarPlane& plane) { HWY_DYNAMIC_DISPATCH(FindFarthest)(plane); }

BoxDepth see_box(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0, CellColumns* columns) {
    return HWY_DYNAMIC_DISPATCH(SeeBox)(box, plane, shift, z0, columns);
}

bool cells_hide(const EpipolarPlane& plane, const SeenBox& box) { return HWY_DYNAMIC_DISPATCH(CellsHide)(plane, box); }

}  // namespace hogel::render::epi
#endif
