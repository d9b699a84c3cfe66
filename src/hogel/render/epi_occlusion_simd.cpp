// The vector twins of find_farthest_plain in epi_kernels.cpp and of cells_hide_plain in epi_occlusion.cpp, compiled for
// every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_occlusion_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>

#include "hogel/render/epi_occlusion_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// A single lane holds no four columns.
void FindFarthest(const EpipolarPlane& plane) { find_farthest_plain(plane); }
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

// First the columns that see the box from a vector of rows of cells, then row by row a vector of columns.
bool CellsHide(const EpipolarPlane& plane, const SeenBox& box) {
    const Tag d;
    const hn::RebindToFloat<Tag> df;
    const hn::RebindToSigned<Tag> di;
    const std::size_t lanes = hn::Lanes(d), rows = PlaneCells::rows(plane.directions);
    const auto n_first = static_cast<float>(plane.first_column), columns = static_cast<float>(plane.columns);
    const auto first = hn::Set(df, n_first), last = hn::Set(df, n_first + columns - 1);
    const auto K_last = hn::Set(df, plane.first_direction + static_cast<float>(plane.directions) - 1);
    const auto z_low = hn::Set(df, box.z_low), z_high = hn::Set(df, box.z_high), margin = hn::Set(df, box.margin);
    const Depths nearest = hn::Set(d, box.nearest);
    HWY_ALIGN std::int32_t begins[hn::MaxLanes(d)], counts[hn::MaxLanes(d)];
    for (std::size_t group = 0; group < rows; group += lanes) {
        const auto Ka = hn::Add(hn::Set(df, plane.first_direction + static_cast<float>(group * cell_directions)),
                                hn::Mul(hn::Iota(df, 0), hn::Set(df, static_cast<float>(cell_directions))));
        const auto Kb = hn::Min(K_last, hn::Add(Ka, hn::Set(df, static_cast<float>(cell_directions - 1))));
        const auto a = hn::Mul(Ka, z_low), b = hn::Mul(Ka, z_high), c = hn::Mul(Kb, z_low), e = hn::Mul(Kb, z_high);
        const auto least = hn::Min(hn::Min(a, b), hn::Min(c, e)), most = hn::Max(hn::Max(a, b), hn::Max(c, e));
        const auto low = hn::Sub(hn::Sub(hn::Set(df, box.x_low), most), margin);
        const auto high = hn::Add(hn::Sub(hn::Set(df, box.x_high), least), margin);
        const auto begin = hn::Max(first, hn::Ceil(low)), end = hn::Min(last, hn::Floor(high));
        // None where the box is not seen at all, however far away that is.
        const auto count = hn::Max(hn::Zero(df), hn::Add(hn::Sub(end, begin), hn::Set(df, 1.0f)));
        hn::Store(hn::ConvertTo(di, hn::Sub(hn::Min(begin, last), first)), di, begins);
        hn::Store(hn::ConvertTo(di, count), di, counts);
        for (std::size_t row = group; row < std::min(rows, group + lanes); ++row) {
            const std::uint32_t* cells = plane.cells->farthest.data() + row * plane.columns + begins[row - group];
            for (auto rest = static_cast<std::size_t>(counts[row - group]); rest != 0;
                 rest -= std::min(rest, lanes), cells += lanes) {
                const auto covered = hn::Lt(hn::LoadU(d, cells), nearest);
                if (!hn::AllFalse(d, hn::AndNot(covered, hn::FirstN(d, rest)))) return false;
            }
        }
    }
    return true;
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(FindFarthest);
HWY_EXPORT(CellsHide);

void find_farthest(const EpipolarPlane& plane) { HWY_DYNAMIC_DISPATCH(FindFarthest)(plane); }

bool cells_hide(const EpipolarPlane& plane, const SeenBox& box) { return HWY_DYNAMIC_DISPATCH(CellsHide)(plane, box); }

}  // namespace hogel
#endif
