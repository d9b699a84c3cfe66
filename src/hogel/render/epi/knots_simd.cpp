// SPDX-License-Identifier: Apache-2.0
// The nodes of strips on which light is kept, made for all that part of a plane shows before any of it is shaded;
// compiled for every instruction set and chosen when first called. The plain twin makes each when it is needed.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi/knots_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <limits>

#include "hogel/render/epi/light.h"
#include "hogel/render/epi/samples.h"
#include "hogel/render/sample_store.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void MakeNodesOfSeen(std::span<const std::uint64_t>, std::span<const StripShades>, LitStrips&, const SampleSource&,
                     bool) {}
#else
constexpr std::size_t max_lanes = hn::MaxLanes(FloatTag());

// Takes the numbers of strips that wait, as words show them, and they no longer do.
class Waiting {
  public:
    Waiting(std::uint8_t* waits, std::uint32_t* found) : waits_(waits), found_(found) {}

    HWY_INLINE void take(std::uint32_t number) {
        found_[count_] = number;
        count_ += waits_[number];
        waits_[number] = 0;
    }
    std::size_t count() const { return count_; }

  private:
    std::uint8_t* waits_;
    std::uint32_t* found_;
    std::size_t count_ = 0;
};

// Returns how many were found.
HWY_INLINE std::size_t find_waiting(std::span<const std::uint64_t> words, std::uint8_t* waits, std::uint32_t* found) {
    const NumberTag d;
    constexpr std::size_t lanes = hn::MaxLanes(d), as_a_rule = 4;
    Waiting waiting(waits, found);
    if (words.empty()) return 0;
    waiting.take(static_cast<std::uint32_t>(words[0]));
    std::size_t i = 1;
    for (; i + lanes <= words.size(); i += lanes) {
        // Where other strips begin: as a rule few, and number 0 never waits.
        const Numbers numbers = numbers_of(words.data() + i), before = numbers_of(words.data() + i - 1);
        const auto others = hn::Ne(numbers, before);
        const std::size_t begins = hn::CountTrue(d, others);
        HWY_ALIGN std::uint32_t begin[lanes];
        hn::Store(hn::IfThenElseZero(hn::FirstN(d, begins), hn::Compress(numbers, others)), d, begin);
        for (std::size_t k = 0; k < as_a_rule; ++k) waiting.take(begin[k]);
        if constexpr (lanes > as_a_rule)
            for (std::size_t k = as_a_rule; k < begins; ++k) waiting.take(begin[k]);
    }
    for (; i < words.size(); ++i) waiting.take(static_cast<std::uint32_t>(words[i]));
    return waiting.count();
}

// A strip a lane, as StripLight.
struct StripsOnGrids {
    HWY_ALIGN float place[2][max_lanes], change[2][max_lanes], scale[2][max_lanes], last[2][max_lanes],
        cells[max_lanes];
    const shading::LightGrid* grids[max_lanes];
};

HWY_INLINE void put_on_grids(const SampleSource::Grids& grids, const std::uint32_t* numbers, std::size_t count,
                             StripsOnGrids& to) {
    const FloatTag d;
    const NumberTag du;
    const hn::RebindToSigned<FloatTag> di;
    static_assert(offsetof(shading::LightGrid, rows) == 8 && offsetof(shading::LightGrid, corner) == 24 &&
                  sizeof(StripOrigin) == 16 && offsetof(StripOrigin, lone) == 12);
    const float *origins[max_lanes], *on[max_lanes];
    for (std::size_t i = 0; i < max_lanes; ++i) {
        const StripOrigin& origin = grids.of_strips[numbers[std::min(i, count - 1)]];
        to.grids[i] = &grids.of_triangles[origin.triangle];
        origins[i] = &origin.weight0;
        on[i] = reinterpret_cast<const float*>(to.grids[i]);
    }
    Floats origin[4], grid[4], more[4];
    for (std::size_t i = 0; i < 4; ++i) {
        origin[i] = load_blocks(origins + i, 0);
        grid[i] = load_blocks(on + i, 0);
        more[i] = load_blocks(on + i, 4);
    }
    transpose(origin);
    transpose(grid);
    transpose(more);
    const Floats zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const auto [weight0, weight1, unused, lone_and_next] = origin;
    const Numbers lone = hn::And(hn::BitCast(du, lone_and_next), hn::Set(du, 0xffff)),
                  next = hn::ShiftRight<16>(hn::BitCast(du, lone_and_next));
    // Of these corners, at the two ends.
    const auto weights = [&](Numbers corner, Floats(&weight)[2]) HWY_ATTR {
        const auto is_lone = hn::RebindMask(d, hn::Eq(corner, lone)), is_next = hn::RebindMask(d, hn::Eq(corner, next));
        weight[0] = hn::IfThenElse(is_lone, weight0, hn::IfThenElse(is_next, hn::Sub(one, weight0), zero));
        weight[1] = hn::IfThenElse(is_lone, weight1, hn::IfThenElse(is_next, zero, hn::Sub(one, weight1)));
    };
    const Numbers corner = hn::BitCast(du, more[2]);
    Floats of_corner[2], of_last[2];
    weights(corner, of_corner);
    weights(hn::IfThenElse(hn::Eq(corner, hn::Zero(du)), hn::Set(du, 2), hn::Sub(corner, hn::Set(du, 1))), of_last);
    const Floats ends[2][2] = {{hn::Sub(one, of_corner[0]), hn::Sub(one, of_corner[1])}, {of_last[0], of_last[1]}};
    Floats most = zero;
    for (int i = 0; i < 2; ++i) {
        const Floats cells_there = hn::ConvertTo(d, hn::BitCast(di, grid[2 + i]));
        const Floats on_axis = hn::Max(cells_there, one),
                     scale = hn::Add(on_axis, hn::Set(d, 2 * shading::LightGrid::inset));
        const Floats change = hn::Sub(ends[i][1], ends[i][0]);
        most = hn::Max(most, hn::IfThenElseZero(hn::Gt(cells_there, zero), hn::Mul(hn::Abs(change), scale)));
        hn::Store(ends[i][0], d, to.place[i]);
        hn::Store(change, d, to.change[i]);
        hn::Store(scale, d, to.scale[i]);
        hn::Store(hn::Sub(on_axis, hn::Set(d, 1.25f)), d, to.last[i]);
    }
    const Floats cells =
        hn::Min(hn::Mul(hn::Set(d, StripLight::per_cell), most), hn::Set(d, StripLight::max_cells - 1));
    hn::Store(hn::Add(hn::ConvertTo(d, hn::ConvertTo(di, cells)), one), d, to.cells);
}

// LightGrid::Place.
HWY_INLINE Numbers place_on_axis(Floats part, float scale, float last, Floats& beyond) {
    const FloatTag d;
    const NumberTag du;
    const Floats parts = hn::Min(hn::Max(part, hn::Zero(d)), hn::Set(d, 1.0f));
    const Floats at = hn::Sub(hn::Mul(parts, hn::Set(d, scale)), hn::Set(d, shading::LightGrid::inset + 0.5f));
    const Floats to_whole = hn::Set(d, shading::LightGrid::to_whole);
    const Floats rounded = hn::Add(hn::Min(hn::Max(at, hn::Set(d, -0.25f)), hn::Set(d, last)), to_whole);
    beyond = hn::Add(hn::Sub(at, hn::Sub(rounded, to_whole)), hn::Set(d, 0.5f));
    return hn::And(hn::BitCast(du, rounded), hn::Set(du, shading::LightGrid::node_bits));
}

// Nodes whose points are on their way from memory: of each where the upper left one is, in words, and how far it lies
// on from there.
class NodesOnGrids {
  public:
    explicit NodesOnGrids(bool colour) : colour_(colour) {}

    // Of the strip in lane `lane`.
    HWY_INLINE void add(const StripsOnGrids& strips, std::size_t lane, const StripShades& strip, std::uint32_t to) {
        const FloatTag d;
        const NumberTag du;
        const shading::LightGrid& grid = *strips.grids[lane];
        Row& row = rows_[row_count_++];
        row = {grid.points,
               grid.columns > 0 ? grid.right : 0,
               grid.rows > 0 ? grid.down : 0,
               to,
               count_,
               count_ + static_cast<std::size_t>(strips.cells[lane]) + 1};
        const auto of = [d, lane](const float* values) HWY_ATTR { return hn::Set(d, values[lane]); };
        for (std::size_t first = count_; first < row.end; first += hn::Lanes(d)) {
            const Floats part = hn::Div(hn::Iota(d, static_cast<float>(first - count_)), of(strips.cells));
            const Floats towards = hn::Add(of(strips.place[0]), hn::Mul(part, of(strips.change[0])));
            const Floats last = hn::Add(of(strips.place[1]), hn::Mul(part, of(strips.change[1])));
            const Floats along = hn::Div(last, hn::Max(towards, hn::Set(d, 1e-30f)));
            Floats down, right;
            const Numbers rows = place_on_axis(towards, strips.scale[0][lane], strips.last[0][lane], down);
            const Numbers columns = place_on_axis(along, strips.scale[1][lane], strips.last[1][lane], right);
            hn::StoreU(hn::Add(hn::Mul(rows, hn::Set(du, row.down)), hn::Mul(columns, hn::Set(du, row.right))), du,
                       upper_ + first);
            hn::StoreU(down, d, down_ + first);
            hn::StoreU(right, d, right_ + first);
            hn::StoreU(hn::Add(hn::Set(d, strip.value0[3]), hn::Mul(part, hn::Set(d, strip.difference[3]))), d,
                       depth_ + first);
        }
        for (std::size_t i = count_; i < row.end; ++i) {
            __builtin_prefetch(row.points + upper_[i]);
            __builtin_prefetch(row.points + upper_[i] + row.down);
        }
        count_ = row.end;
    }
    bool is_full() const { return count_ > most || row_count_ == max_rows; }

    HWY_INLINE void make(LitStrips::Node* nodes) {
        for (std::size_t k = 0; k < row_count_; ++k) {
            const Row& row = rows_[k];
            for (std::size_t i = row.begin; i < row.end; ++i) make_node(row, i, nodes[row.to + i - row.begin]);
        }
        count_ = row_count_ = 0;
    }

    static constexpr std::size_t max_cells = 512;  // of a strip

  private:
    struct Row {
        const std::uint32_t* points;
        std::uint32_t right, down;
        std::uint32_t to;
        std::size_t begin, end;
    };

    HWY_INLINE void make_node(const Row& row, std::size_t i, LitStrips::Node& node) const {
        using Tag = hn::Full128<float>;
        using Four = hn::Vec<Tag>;
        const Tag d;
        const std::uint32_t *upper = row.points + upper_[i], *lower = upper + row.down;
        if (HWY_UNLIKELY(!shading::LightGrid::are_filled(upper, upper + row.right, lower, lower + row.right))) {
            node[3] = std::numeric_limits<float>::quiet_NaN();
            return;
        }
        const auto load = [d](const std::uint32_t* point)
                              HWY_ATTR { return hn::Load(d, reinterpret_cast<const float*>(point)); };
        const auto between = [](Four v, Four w, Four part)
                                 HWY_ATTR { return hn::Add(v, hn::Mul(part, hn::Sub(w, v))); };
        const Four right = hn::Set(d, right_[i]);
        const Four light = hn::Max(between(between(load(upper), load(upper + row.right), right),
                                           between(load(lower), load(lower + row.right), right), hn::Set(d, down_[i])),
                                   hn::Zero(d));
        hn::StoreU(hn::IfThenElse(hn::FirstN(d, 3), light, hn::Set(d, depth_[i])), d, node.data());
        if (!colour_) node = {luminance({node[0], node[1], node[2]}), 0, 0, node[3]};
    }

    static constexpr std::size_t most = 256, max_rows = 64, room = most + max_cells + 1 + max_lanes;
    bool colour_;
    std::size_t count_ = 0, row_count_ = 0;
    Row rows_[max_rows];
    std::uint32_t upper_[room];
    float down_[room], right_[room], depth_[room];
};

void MakeNodesOfSeen(std::span<const std::uint64_t> words, std::span<const StripShades> strips, LitStrips& lit,
                     const SampleSource& samples, bool colour) {
    if (!lit.has_points()) return;
    thread_local std::vector<std::uint32_t> found;
    found.resize(strips.size() + 1);
    const std::size_t count = find_waiting(words, lit.waits(), found.data());
    if (count == 0) return;
    const SampleSource::Grids grids = samples.grids();
    StripsOnGrids on_grids;
    NodesOnGrids nodes(colour);
    for (std::size_t first = 0; first < count; first += max_lanes) {
        const std::size_t some = std::min(max_lanes, count - first);
        put_on_grids(grids, &found[first], some, on_grids);
        for (std::size_t i = 0; i < some; ++i) {
            const std::size_t number = found[first + i];
            const float cells = on_grids.cells[i];
            if (cells > NodesOnGrids::max_cells) {
                lit.add_unmade_nodes(number, cells);
                continue;
            }
            nodes.add(on_grids, i, strips[number], lit.add_nodes(number, cells));
            if (nodes.is_full()) nodes.make(lit.nodes());
        }
    }
    nodes.make(lit.nodes());
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::render::epi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::render::epi {

HWY_EXPORT(MakeNodesOfSeen);

void make_nodes_of_seen(std::span<const std::uint64_t> words, std::span<const StripShades> strips, LitStrips& lit,
                        const SampleSource& samples, bool colour) {
    HWY_DYNAMIC_DISPATCH(MakeNodesOfSeen)(words, strips, lit, samples, colour);
}

}  // namespace hogel::render::epi
#endif
