// The vector twin of epi_light.cpp, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi_light_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <bit>
#include <cmath>

#include "hogel/render/epi_light_internal.h"
#include "hogel/render/epi_samples_internal.h"
#include "hogel/render/sample_store_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void ShadeLit(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
              const SampleSource& samples, const ShadedPlane& out) {
    shade_lit_plain(plane, strips, lit, samples, out);
}
#else
using Four = hn::Full128<float>;

// A place on the grid that a strip crosses, and the points around it.
struct GridPlace {
    std::uint32_t row, column;
    hn::Vec<Four> beyond;  // lane 0: of the row, lane 1: of the column
    const std::uint32_t *upper, *lower;

    HWY_INLINE GridPlace(const StripLight& light, float part) {
        const Four d;
        const hn::Full128<std::uint64_t> d64;
        // Lane 0: towards the side opposite the corner, lane 1: along the row. LightGrid::along and LightGrid::Place.
        const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
        const auto ends = hn::Load(d, light.place), axes = hn::Load(d, light.scale);
        const auto place = hn::Add(ends, hn::Mul(hn::Set(d, part), hn::Shuffle1032(ends)));
        const auto row_width = hn::Max(hn::Broadcast<0>(place), hn::Set(d, 1e-30f));
        const auto in_row = hn::IfThenElse(hn::FirstN(d, 1), place, hn::Div(place, row_width));
        const auto parts = hn::Min(hn::Max(in_row, zero), one);
        const auto at = hn::Sub(hn::Mul(parts, axes), hn::Set(d, LightGrid::inset + 0.5f));
        const auto to_whole = hn::Set(d, LightGrid::to_whole);
        const auto rounded = hn::Add(hn::Min(hn::Max(at, hn::Set(d, -0.25f)), hn::Shuffle1032(axes)), to_whole);
        beyond = hn::Add(hn::Sub(at, hn::Sub(rounded, to_whole)), half);
        const std::uint64_t nodes = hn::GetLane(hn::BitCast(d64, rounded));
        row = static_cast<std::uint32_t>(nodes) & LightGrid::node_bits;
        column = static_cast<std::uint32_t>(nodes >> 32) & LightGrid::node_bits;
        upper = light.points + std::uint64_t{row} * light.down + std::uint64_t{column} * light.right;
        lower = upper + light.down;
    }
};

// Vectors of samples of a plane.
class LitSamples {
  public:
    LitSamples(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
               const SampleSource& samples, bool colour)
        : plane_(plane), strips_(strips.data()), lit_(lit), samples_(samples), colour_(colour) {}

    // The first in column and direction k, and what their words say.
    HWY_INLINE void shade(const std::uint64_t* words, std::size_t column, std::size_t k, Floats (&values)[4]) {
        const FloatTag d;
        const NumberTag du;
        const Floats n = hn::Set(d, static_cast<float>(plane_.first_column) + static_cast<float>(column));
        const Floats K = hn::Iota(d, plane_.first_direction + static_cast<float>(k));
        const Numbers numbers = numbers_of(words);
        const auto first = static_cast<std::uint32_t>(words[0]);
        const auto nobody = hn::RebindMask(d, hn::Eq(numbers, hn::Set(du, EpipolarPlane::nobody)));
        const Floats endless = hn::Set(d, strips_[EpipolarPlane::nobody].value0[3]);
        if (!hn::AllTrue(du, hn::Eq(numbers, hn::Set(du, first)))) {
            const float* from[hn::MaxLanes(FloatTag())];
            for (std::size_t i = 0; i < hn::MaxLanes(d); ++i) from[i] = &strips_[words[i] & 0xffffffff].x0;
            const Floats parts = parts_of_several(from, n, K);
            shade_several(words, parts, values);
            // Unmade nodes have no depth.
            if (HWY_UNLIKELY(!hn::AllFalse(d, hn::IsNaN(values[3])))) shade_slowly(words, column, k, parts, values);
            values[3] = hn::IfThenElse(nobody, endless, values[3]);
        } else if (first != EpipolarPlane::nobody) {
            const Floats parts = parts_of_one(strips_[first], n, K);
            if (!shade_one(first, parts, values)) shade_several(words, parts, values);
            if (HWY_UNLIKELY(!hn::AllFalse(d, hn::IsNaN(values[3])))) shade_slowly(words, column, k, parts, values);
        } else {
            for (int i = 0; i < 4; ++i) values[i] = hn::Set(d, strips_[EpipolarPlane::nobody].value0[i]);
        }
    }

  private:
    // As LitStrips::Place: returns the cells.
    static HWY_INLINE Floats place_on_lines(Floats parts, Floats cells, Floats last, Floats& beyond) {
        const Floats at = hn::Mul(parts, cells), cell = hn::Min(hn::Floor(at), last);
        beyond = hn::Sub(at, cell);
        return cell;
    }

    // Of samples that all show one strip; false, and nothing done, where they lie in different cells.
    HWY_INLINE bool shade_one(std::uint32_t number, Floats parts, Floats (&values)[4]) const {
        const FloatTag d;
        const LitStrips::Line& line = lit_.lines()[number];
        Floats beyond;
        const Floats cells = place_on_lines(parts, hn::Set(d, line.cells), hn::Set(d, line.last), beyond);
        const float cell = hn::GetLane(cells);
        if (!hn::AllTrue(d, hn::Eq(cells, hn::Set(d, cell)))) return false;
        const LitStrips::Node* node = lit_.nodes() + line.first + static_cast<std::size_t>(cell);
        for (std::size_t i = 0; i < 4; ++i) {
            const Floats here = hn::Set(d, node[0][i]);
            values[i] = hn::Add(here, hn::Mul(beyond, hn::Sub(hn::Set(d, node[1][i]), here)));
        }
        return true;
    }

    // Of samples that show different strips or different cells.
    HWY_INLINE void shade_several(const std::uint64_t* words, Floats parts, Floats (&values)[4]) const {
        const NumberTag du;
        constexpr std::size_t lanes = hn::MaxLanes(FloatTag());
        const float* from[lanes];
        const auto* lines = reinterpret_cast<const float*>(lit_.lines());
        for (std::size_t i = 0; i < lanes; ++i) from[i] = lines + 4 * (words[i] & 0xffffffff);
        Floats line[4] = {load_blocks(from + 0, 0), load_blocks(from + 1, 0), load_blocks(from + 2, 0),
                          load_blocks(from + 3, 0)};
        transpose(line);
        Floats beyond;
        const Floats cells = place_on_lines(parts, line[1], line[2], beyond);
        const hn::RebindToSigned<FloatTag> di;
        HWY_ALIGN std::uint32_t nodes[lanes];
        hn::Store(hn::Add(hn::BitCast(du, line[0]), hn::BitCast(du, hn::ConvertTo(di, cells))), du, nodes);
        const auto* values_of_nodes = reinterpret_cast<const float*>(lit_.nodes());
        for (std::size_t i = 0; i < lanes; ++i) from[i] = values_of_nodes + 4 * std::size_t{nodes[i]};
        const auto interpolated = [&](std::size_t i, Floats part) HWY_ATTR {
            const Floats here = load_blocks(from + i, 0), next = load_blocks(from + i, 4);
            return hn::Add(here, hn::Mul(part, hn::Sub(next, here)));
        };
        values[0] = interpolated(0, hn::Broadcast<0>(beyond));
        values[1] = interpolated(1, hn::Broadcast<1>(beyond));
        values[2] = interpolated(2, hn::Broadcast<2>(beyond));
        values[3] = interpolated(3, hn::Broadcast<3>(beyond));
        transpose(values);
    }

    // Which lanes have no depth, as bits.
    static HWY_INLINE std::uint64_t lanes_without_depth(const Floats (&values)[4]) {
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(FloatTag(), hn::IsNaN(values[3]), bytes);
        return bytes[0] | std::uint64_t{bytes[1]} << 8;
    }

    // Makes the nodes that are missing, and asks for the samples that have none.
    HWY_NOINLINE void shade_slowly(const std::uint64_t* words, std::size_t column, std::size_t k, Floats parts,
                                   Floats (&values)[4]) {
        const FloatTag d;
        constexpr std::size_t lanes = hn::MaxLanes(FloatTag());
        static_assert(lanes <= 16);
        HWY_ALIGN float part[lanes], value[4][lanes];
        hn::Store(parts, d, part);
        const std::uint64_t missing = lanes_without_depth(values);
        // Several strips at a time wait for memory.
        bool points = false;
        for (std::uint64_t rest = missing; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const std::size_t number = words[i] & 0xffffffff;
            const LitStrips::Line& line = lit_.lines()[number];
            if (line.from != LightFrom::points) continue;
            points = true;
            if (line.first != LitStrips::unmade) continue;
            const GridPlace place(lit_.light(number, samples_), part[i]);
            __builtin_prefetch(place.upper);
            __builtin_prefetch(place.lower);
        }
        if (points) {
            for (std::uint64_t rest = missing; rest != 0; rest &= rest - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(rest));
                const std::size_t number = words[i] & 0xffffffff;
                if (lit_.lines()[number].from == LightFrom::points) make_nodes(number, part[i]);
            }
            shade_several(words, parts, values);
        }
        std::uint64_t rest = lanes_without_depth(values);
        if (rest == 0) return;
        for (int i = 0; i < 4; ++i) hn::Store(values[i], d, value[i]);
        for (; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const std::size_t number = words[i] & 0xffffffff;
            const Rgb radiance = samples_.radiance(number, part[i], column, k + i);
            value[0][i] = colour_ ? radiance.r : luminance(radiance);
            value[1][i] = radiance.g;
            value[2][i] = radiance.b;
            value[3][i] = strips_[number].value0[3] + part[i] * strips_[number].difference[3];
        }
        for (int i = 0; i < 4; ++i) values[i] = hn::Load(d, value[i]);
    }

    // Around part of a strip LightFrom::points; and, as others will be asked for soon, all nodes in that stretch of the
    // strip for which no points have to be made.
    void make_nodes(std::size_t number, float part) {
        const LitStrips::Line& line = lit_.lines()[number];
        const auto cell = static_cast<std::size_t>(LitStrips::Place(line, part).cell);
        if (const LitStrips::Node* around = lit_.nodes() + line.first + cell;
            !std::isnan(around[0][3]) && !std::isnan(around[1][3]))
            return;
        const StripLight& light = lit_.light(number, samples_);
        const StripShades& strip = strips_[number];
        constexpr std::size_t stretch = 8;
        const std::size_t first = cell / stretch * stretch,
                          last = std::min(first + stretch, static_cast<std::size_t>(line.cells));
        LitStrips::Node* const nodes = lit_.nodes() + line.first;
        for (std::size_t i = first; i <= last; ++i) {
            if (!std::isnan(nodes[i][3])) continue;
            const float at = static_cast<float>(i) / line.cells;
            if (!light_of_points(light, at, number, i == cell || i == cell + 1, nodes[i])) continue;
            if (!colour_) nodes[i] = {luminance({nodes[i][0], nodes[i][1], nodes[i][2]}), 0, 0, 0};
            nodes[i][3] = strip.value0[3] + at * strip.difference[3];
        }
    }

    // The light part of the way along a strip, and a zero; false where points for it have to be made and it is not
    // needed.
    HWY_INLINE bool light_of_points(const StripLight& light, float part, std::size_t strip, bool needed,
                                    LitStrips::Node& value) const {
        const Four d;
        const GridPlace place(light, part);
        hn::Vec<Four> corner[4];
        if (LightGrid::are_made(place.upper, place.upper + light.right, place.lower, place.lower + light.right)) {
            // The word that says so is −0 as a float.
            const auto load = [d](const std::uint32_t* point)
                                  HWY_ATTR { return hn::Load(d, reinterpret_cast<const float*>(point)); };
            corner[0] = load(place.upper);
            corner[1] = load(place.upper + light.right);
            corner[2] = load(place.lower);
            corner[3] = load(place.lower + light.right);
        } else if (needed) {
            const LightCache::Corners made = samples_.corners(strip, place.row, place.column);
            for (std::size_t k = 0; k < 4; ++k) corner[k] = hn::LoadU(d, made[k].data());
        } else {
            return false;
        }
        const auto right = hn::Broadcast<1>(place.beyond), down = hn::Broadcast<0>(place.beyond);
        const auto between = [](hn::Vec<Four> v, hn::Vec<Four> w, hn::Vec<Four> to_w)
                                 HWY_ATTR { return hn::Add(v, hn::Mul(to_w, hn::Sub(w, v))); };
        hn::StoreU(hn::Max(between(between(corner[0], corner[1], right), between(corner[2], corner[3], right), down),
                           hn::Zero(d)),
                   d, value.data());
        return true;
    }

    const EpipolarPlane& plane_;
    const StripShades* strips_;
    LitStrips& lit_;
    const SampleSource& samples_;
    bool colour_;
};

void ShadeLit(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
              const SampleSource& samples, const ShadedPlane& out) {
    LitSamples lit_samples(plane, strips, lit, samples, out.values[1] != nullptr);
    shade_vectors(plane, out,
                  [&](const std::uint64_t* words, std::size_t column, std::size_t k, Floats(&values)[4])
                      HWY_ATTR { lit_samples.shade(words, column, k, values); });
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(ShadeLit);

void shade_lit(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
               const SampleSource& samples, const ShadedPlane& out) {
    HWY_DYNAMIC_DISPATCH(ShadeLit)(plane, strips, lit, samples, out);
}

}  // namespace hogel
#endif
