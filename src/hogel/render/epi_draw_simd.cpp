// The vector twin of draw_plain in epi_kernels.cpp, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_draw_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/epi_hits_internal.h"
#include "hogel/render/epi_kernels_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// In about processor cycles: a vector of directions or columns, candidates in it, a hit that is put in its place by
// itself, a column of directions at once.
constexpr float cost_of_vector = 20, cost_of_candidates = 12, cost_of_hit = 3, cost_of_row = 7;

constexpr std::size_t most_lanes = HWY_MAX_BYTES / 4;

// Bounds of what a vector of strips can cover, and the way to go over each that takes least.
struct Bounded {
    enum Way : std::int32_t { nowhere, rows, directions, columns };
    HWY_ALIGN float n_begin[most_lanes], n_end[most_lanes], per_z0[most_lanes], per_z1[most_lanes], margin[most_lanes],
        K_begin[most_lanes], K_end[most_lanes];
    HWY_ALIGN std::int32_t way[most_lanes], nearest[most_lanes];
};

// Of the samples of a plane.
struct Extent {
    float n_first, n_last, k_first, k_last;
    bool fronts_only;
};

// The directions of a vector in which interleaving makes words of neighbours, and the lanes in their own order.
struct LaneOrder {
    HWY_ALIGN float in_order[most_lanes], steps[most_lanes];

    LaneOrder() {
        const std::size_t half = hn::Lanes(FloatTag()) / 2;
        for (std::size_t i = 0; i < 2 * half; ++i) {
            const std::size_t direction = i % 4 / 2 * half + i / 4 * 2 + i % 2;
            in_order[i] = static_cast<float>(direction);
            steps[i] = static_cast<float>(i);
        }
    }
};

// What the loops below need to know of a strip and the plane that it is drawn into.
struct Drawing {
    const Strip& strip;
    std::uint32_t index, number;
    const EpipolarPlane& plane;
    Hits& hits;
    Candidates& candidates;
    const Extent& extent;
    const LaneOrder& lanes;
    std::uint32_t nearest;  // ordered bits of a depth in front of all samples of the strip
};

// The columns that see a strip from each of a vector's rows of cells.
HWY_INLINE void columns_of_rows(const StripLanes& strip, const Extent& extent, std::size_t first_row, float K_end,
                                Floats& first, Floats& last) {
    const FloatTag d;
    const Floats one = hn::Set(d, 1.0f), size = hn::Set(d, static_cast<float>(cell_directions));
    const Floats K_low = hn::Add(hn::Set(d, extent.k_first + static_cast<float>(first_row * cell_directions)),
                                 hn::Mul(hn::Iota(d, 0), size));
    const Floats K_high = hn::Min(hn::Add(K_low, hn::Sub(size, one)), hn::Set(d, K_end));
    // c is monotonic in K, also as it is rounded.
    const Floats a = strip.c0(K_low), b = strip.c0(K_high), c = strip.c1(K_low), e = strip.c1(K_high);
    const Floats low = hn::Floor(hn::Min(hn::Min(a, b), hn::Min(c, e)));
    const Floats high = hn::Floor(hn::Max(hn::Max(a, b), hn::Max(c, e)));
    first = hn::Max(hn::Set(d, extent.n_first), hn::Add(low, one));
    last = hn::Min(hn::Set(d, extent.n_last), high);
}

#if HWY_TARGET != HWY_SCALAR
// One direction a lane, and a column at a time, of which the lanes lie side by side: those that are not hits keep what
// they have, even if they lie beyond the plane's directions. Vectors begin where cells do, or a part of one, and what
// is hidden is passed over.
void along_rows(const Drawing& on, float K_begin, float K_end) {
    const FloatTag d;
    const IntTag di;
    const NumberTag du;
    const hn::RepartitionToWide<NumberTag> d64;
    const StripLanes strip = in_all_lanes(on.strip);
    const std::size_t lanes = hn::Lanes(d), half = lanes / 2;
    const std::size_t plane_columns = on.plane.columns, directions = on.plane.directions;
    std::uint64_t* const plane_words = on.plane.words;
    const bool fronts_only = on.plane.fronts_only;
    const std::uint32_t* const farthest = on.plane.cells->farthest.data();
    const auto number = hn::Set(du, on.number), nearest = hn::Set(du, on.nearest);
    const Floats nothing = hn::BitCast(d, hn::Set(di, -1));
    const Floats order = hn::Load(d, on.lanes.in_order), last = hn::Set(d, K_end);
    const auto k_begin = static_cast<std::size_t>(K_begin - on.extent.k_first);
    const auto k_end = static_cast<std::size_t>(K_end - on.extent.k_first);
    const std::size_t row_end = k_end / cell_directions + 1;
    HWY_ALIGN float firsts[most_lanes];
    HWY_ALIGN std::int32_t columns[most_lanes], counts[most_lanes];
    std::size_t drawn = 0;
    for (std::size_t group = k_begin / cell_directions; group < row_end; group += lanes) {
        Floats from, to;
        columns_of_rows(strip, on.extent, group, K_end, from, to);
        hn::Store(from, d, firsts);
        hn::Store(hn::ConvertTo(di, hn::Sub(from, hn::Set(d, on.extent.n_first))), di, columns);
        hn::Store(hn::ConvertTo(di, hn::Add(hn::Sub(to, from), hn::Set(d, 1.0f))), di, counts);
        for (std::size_t row = group; row < std::min(row_end, group + lanes); ++row) {
            float first = firsts[row - group];
            auto column = static_cast<std::size_t>(columns[row - group]);
            for (std::int32_t count = counts[row - group]; count > 0;
                 count -= static_cast<std::int32_t>(lanes), first += static_cast<float>(lanes), column += lanes) {
                std::uint64_t open =
                    bits_of(hn::Not(hn::Lt(hn::LoadU(du, farthest + row * plane_columns + column), nearest)));
                open &= ~std::uint64_t{0} >> (64 - std::min(count, 32));
                if (open == 0) continue;
                drawn += static_cast<std::size_t>(std::popcount(open));
                for (std::size_t k = row * cell_directions; k < (row + 1) * cell_directions && k <= k_end; k += lanes) {
                    const Floats K = hn::Add(hn::Set(d, on.extent.k_first + static_cast<float>(k)), order);
                    const Floats c0 = strip.c0(K);
                    const Floats c1 = hn::IfThenElse(hn::Le(K, last), strip.c1(K, c0, fronts_only), c0);
                    const Floats slope = strip.slope(c0, c1);
                    for (std::uint64_t rest = open; rest != 0; rest &= rest - 1) {
                        const auto next = static_cast<std::size_t>(std::countr_zero(rest));
                        const Floats n = hn::Set(d, first + on.lanes.steps[next]);
                        const Floats z = hn::BitCast(d, ordered_bits_of(strip.depth(n, c0, slope)));
                        const auto depth = hn::BitCast(du, hn::IfThenElse(StripLanes::covers(n, c0, c1), z, nothing));
                        std::uint64_t* words = plane_words + (column + next) * directions + k;
                        const auto low = hn::BitCast(d64, hn::InterleaveLower(du, number, depth));
                        const auto high = hn::BitCast(d64, hn::InterleaveUpper(du, number, depth));
                        hn::StoreU(hn::Min(low, hn::LoadU(d64, words)), d64, words);
                        hn::StoreU(hn::Min(high, hn::LoadU(d64, words + half)), d64, words + half);
                    }
                }
            }
        }
    }
    on.plane.cells->drawn += drawn;
}
#endif

// One direction a lane: all columns between c_0 and c_1 are hits.
void along_directions(const Drawing& on, float K_begin, float K_end) {
    const FloatTag d;
    const IntTag di;
    const StripLanes strip = in_all_lanes(on.strip);
    const Floats one = hn::Set(d, 1.0f), n_first = hn::Set(d, on.extent.n_first), n_last = hn::Set(d, on.extent.n_last);
    const Floats none = hn::Set(d, on.extent.n_first - 1), K_last = hn::Set(d, K_end),
                 k_first = hn::Set(d, on.extent.k_first);
    const Ints directions = hn::Set(di, static_cast<std::int32_t>(on.plane.directions));
    for (float begin = K_begin; begin <= K_end; begin += static_cast<float>(hn::Lanes(d))) {
        const Floats K = hn::Iota(d, begin);
        const Floats c0 = strip.c0(K), c1 = strip.c1(K, c0, on.plane.fronts_only), slope = strip.slope(c0, c1);
        const Floats end = hn::IfThenElse(hn::Le(K, K_last), hn::Min(n_last, hn::Floor(hn::Max(c0, c1))), none);
        const Ints k = hn::ConvertTo(di, hn::Sub(K, k_first));
        Floats n = hn::Max(n_first, hn::Add(hn::Floor(hn::Min(c0, c1)), one));
        for (FloatMask hit = hn::Le(n, end); !hn::AllFalse(d, hit); hit = hn::Le(n, end)) {
            const Ints column = hn::ConvertTo(di, hn::Sub(n, n_first));
            on.hits.add(hit, strip.depth(n, c0, slope), hn::Add(hn::Mul(column, directions), k), on.number);
            n = hn::Add(n, one);
        }
    }
}

// How far along_columns has come: a vector's first column, and how many directions of each of its columns are done.
struct Progress {
    float begin, directions;
};

// One column a lane: candidates are the directions from K_0 to K_1, the ends' own, and a margin to either side. False
// where it has to go on when those that wait have been drawn.
bool along_columns(const Drawing& on, float n_end, float per_z0, float per_z1, float margin, Progress& at) {
    const FloatTag d;
    Candidates& candidates = on.candidates;
    const Floats x0 = hn::Set(d, on.strip.x0), x1 = hn::Set(d, on.strip.x1);
    const Floats steep0 = hn::Set(d, per_z0), steep1 = hn::Set(d, per_z1);
    const Floats before = hn::Set(d, on.extent.k_first + margin), beyond = hn::Set(d, on.extent.k_first - margin);
    const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f), none = hn::Set(d, -1.0f);
    const Floats k_last = hn::Set(d, on.extent.k_last - on.extent.k_first), columns_end = hn::Set(d, n_end);
    std::size_t count = candidates.begin();
    float done = at.directions;
    for (float begin = at.begin; begin <= n_end; begin += static_cast<float>(hn::Lanes(d)), done = 0) {
        const Floats n = hn::Iota(d, begin);
        const Floats K0 = hn::Mul(hn::Sub(x0, n), steep0), K1 = hn::Mul(hn::Sub(x1, n), steep1);
        const Floats low = hn::Sub(hn::Min(K0, K1), before), high = hn::Sub(hn::Max(K0, K1), beyond);
        const Floats end = hn::IfThenElse(hn::Le(n, columns_end), hn::Min(k_last, high), none);
        Floats k = hn::Add(hn::Max(zero, hn::Ceil(low)), hn::Set(d, done));
        // Most have one or two.
        count += candidates.add(n, k, end, count);
        for (std::size_t more = 1; more != 0;) {
            k = hn::Add(k, one);
            done += 1;
            more = candidates.add(n, k, end, count);
            count += more;
            if (HWY_LIKELY(!Candidates::is_full(count))) continue;
            at = {begin, done + 1};
            candidates.end(on.index, count);
            return false;
        }
    }
    candidates.end(on.index, count);
    return true;
}

// @param ends  x0, z0, x1, z1 of a vector of strips
void bound_strips(const float* ends, const Extent& plane, Bounded& to) {
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
        const Floats most_steps = hn::Max(hn::Abs(k_first), hn::Abs(k_last));
        const Floats size =
            hn::Add(hn::Max(hn::Abs(x0), hn::Abs(x1)), hn::Mul(most_steps, hn::Max(hn::Abs(z0), hn::Abs(z1))));
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

void Draw(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane) {
    const auto n_first = static_cast<float>(plane.first_column);
    const Extent extent{n_first, n_first + static_cast<float>(plane.columns) - 1, plane.first_direction,
                        plane.first_direction + static_cast<float>(plane.directions) - 1, plane.fronts_only};
    const LaneOrder order;
    Hits hits(plane);
    Candidates candidates(plane, strips, first, hits);
    const std::size_t lanes = hn::Lanes(FloatTag());
    Bounded bounded;
    HWY_ALIGN Strip last[most_lanes];
    for (std::size_t begin = 0; begin < strips.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, strips.size() - begin);
        const Strip* some = strips.data() + begin;
        if (count < lanes) {
            std::fill(last, last + lanes, *some);
            some = std::copy(some, some + count, last) - count;
        }
        bound_strips(&some->x0, extent, bounded);
        for (std::size_t i = 0; i < count; ++i) {
            const auto index = static_cast<std::uint32_t>(begin + i);
            const Drawing on{some[i], index, static_cast<std::uint32_t>(first) + index,     plane, hits, candidates,
                             extent,  order, static_cast<std::uint32_t>(bounded.nearest[i])};
            switch (bounded.way[i]) {
#if HWY_TARGET != HWY_SCALAR
                case Bounded::rows:
                    along_rows(on, bounded.K_begin[i], bounded.K_end[i]);
                    break;
#endif
                case Bounded::directions:
                    along_directions(on, bounded.K_begin[i], bounded.K_end[i]);
                    break;
                case Bounded::columns:
                    for (Progress at{bounded.n_begin[i], 0}; !along_columns(on, bounded.n_end[i], bounded.per_z0[i],
                                                                            bounded.per_z1[i], bounded.margin[i], at);)
                        candidates.draw();
                    break;
                default:
                    break;
            }
        }
    }
    candidates.draw();
    hits.draw();
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(Draw);

void draw(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane) {
    HWY_DYNAMIC_DISPATCH(Draw)(strips, first, plane);
}

std::vector<std::int64_t> kernel_targets() { return hwy::SupportedAndGeneratedTargets(); }

void use_kernel_target(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace hogel
#endif
