// SPDX-License-Identifier: Apache-2.0
// The vector twins of epi_kernels.cpp that turn what is seen into values, compiled for every instruction set and chosen
// when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi/shade_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <bit>
#include <cstddef>

#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/samples.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void Shade(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out) {
    shade_plain(plane, strips, out);
}
#else
using FloatMask = hn::Mask<FloatTag>;

// The strips of a vector of samples. Vector i of each sort holds those of samples 4 b + i in its blocks b of four
// lanes.
struct Blocks {
    Floats place[4], value0[4], difference[4];
};

// Whole cache lines where a vector is one, for no more parts of lines than lines are loaded in a cycle.
HWY_INLINE void load_strips(const StripShades* const* strips, Blocks& to) {
    const FloatTag d;
#if HWY_MAX_BYTES >= 64
    const NumberTag du;
    if constexpr (hn::MaxLanes(d) == 16) {
        const auto odd = hn::RebindMask(d, hn::Ne(hn::And(hn::Iota(du, 0), hn::Set(du, 4)), hn::Zero(du)));
        for (std::size_t i = 0; i < 4; ++i) {
            const Floats a = hn::Load(d, &strips[i]->x0), b = hn::Load(d, &strips[i + 4]->x0),
                         c = hn::Load(d, &strips[i + 8]->x0), e = hn::Load(d, &strips[i + 12]->x0);
            // Their blocks are place, value0, difference, and one of nothing.
            const Floats ac = hn::ConcatLowerLower(d, c, a), be = hn::ConcatLowerLower(d, e, b);
            to.place[i] = hn::IfThenElse(odd, hn::SwapAdjacentBlocks(be), ac);
            to.value0[i] = hn::IfThenElse(odd, be, hn::SwapAdjacentBlocks(ac));
            to.difference[i] = hn::IfThenElse(odd, hn::SwapAdjacentBlocks(hn::ConcatUpperUpper(d, e, b)),
                                              hn::ConcatUpperUpper(d, c, a));
        }
        return;
    }
#endif
    const float* from[hn::MaxLanes(d)];
    for (std::size_t i = 0; i < hn::MaxLanes(d); ++i) from[i] = &strips[i]->x0;
    for (std::size_t i = 0; i < 4; ++i) {
        to.place[i] = load_blocks(from + i, 0);
        to.value0[i] = load_blocks(from + i, 4);
        to.difference[i] = load_blocks(from + i, 8);
    }
}

// Of samples that show any strips.
HWY_INLINE void shade_several(const std::uint64_t* words, const StripShades* strips, Floats n, Floats K,
                              Floats (&values)[4]) {
    const StripShades* from[hn::MaxLanes(FloatTag())];
    for (std::size_t i = 0; i < hn::MaxLanes(FloatTag()); ++i) from[i] = &strips[words[i] & 0xffffffff];
    Blocks blocks;
    load_strips(from, blocks);
    transpose(blocks.place);
    const Floats part = parts_of_strips(n, K, blocks.place);
    const auto value = [&](std::size_t i, Floats parts)
                           HWY_ATTR { return hn::Add(blocks.value0[i], hn::Mul(parts, blocks.difference[i])); };
    values[0] = value(0, hn::Broadcast<0>(part));
    values[1] = value(1, hn::Broadcast<1>(part));
    values[2] = value(2, hn::Broadcast<2>(part));
    values[3] = value(3, hn::Broadcast<3>(part));
    transpose(values);
}

// Of samples that show up to three: the last and the middle one in the lanes of these masks, the first in the others.
template <bool depth>
HWY_INLINE void shade_three(const StripShades& first, const StripShades& middle, const StripShades& last,
                            FloatMask of_middle, FloatMask of_last, Floats n, Floats K, Floats (&values)[4]) {
    const FloatTag d;
    const auto in_lanes = [&](const float& a, const float& b, const float& c) HWY_ATTR {
        return hn::IfThenElse(of_last, hn::Set(d, c), hn::IfThenElse(of_middle, hn::Set(d, b), hn::Set(d, a)));
    };
    const Floats part =
        parts_of_strips(n, K,
                        {in_lanes(first.x0, middle.x0, last.x0), in_lanes(first.z0, middle.z0, last.z0),
                         in_lanes(first.dx, middle.dx, last.dx), in_lanes(first.dz, middle.dz, last.dz)});
    for (int i = 0; i < (depth ? 4 : 3); ++i)
        values[i] = hn::Add(in_lanes(first.value0[i], middle.value0[i], last.value0[i]),
                            hn::Mul(part, in_lanes(first.difference[i], middle.difference[i], last.difference[i])));
}

// Of samples that all show one.
template <bool depth>
HWY_INLINE void shade_one(const StripShades& strip, Floats n, Floats K, Floats (&values)[4]) {
    const FloatTag d;
    const Floats part = parts_of_one(strip, n, K);
    for (int i = 0; i < (depth ? 4 : 3); ++i)
        values[i] = hn::Add(hn::Set(d, strip.value0[i]), hn::Mul(part, hn::Set(d, strip.difference[i])));
}

// A vector of samples of a plane. Whether it shows one strip, two or three is more than could be predicted, so there is
// one way for them all, unless most strips are `large`. (Lambdas are not inlined where they are called twice.)
template <bool depth, bool large>
struct ShadeStrips {
    const StripShades* strips;
    float first_column, first_direction;

    HWY_INLINE void operator()(const std::uint64_t* words, std::size_t column, std::size_t k,
                               Floats (&values)[4]) const {
        const FloatTag d;
        const NumberTag du;
        const std::size_t lanes = hn::Lanes(d);
        const Floats n = hn::Set(d, first_column + static_cast<float>(column));
        const Floats K = hn::Iota(d, first_direction + static_cast<float>(k));
        const auto first = static_cast<std::uint32_t>(words[0]), last = static_cast<std::uint32_t>(words[lanes - 1]);
        const Numbers numbers = numbers_of(words);
        const auto of_first = hn::Eq(numbers, hn::Set(du, first)), of_last = hn::Eq(numbers, hn::Set(du, last));
        const std::uint64_t others = bits_of(du, hn::Not(hn::Or(of_first, of_last)));
        if ((large || first == EpipolarPlane::nobody) && others == 0 && last == first) {
            if (large && first != EpipolarPlane::nobody)
                shade_one<depth>(strips[first], n, K, values);
            else
                for (int i = 0; i < 4; ++i) values[i] = hn::Set(d, strips[EpipolarPlane::nobody].value0[i]);
            return;
        }
        // The last again if there is no other.
        const std::uint64_t or_last = others | std::uint64_t{1} << (lanes - 1);
        const auto middle = static_cast<std::uint32_t>(words[std::countr_zero(or_last)]);
        const auto of_middle = hn::Eq(numbers, hn::Set(du, middle));
        if (hn::AllTrue(du, hn::Or(of_middle, hn::Or(of_first, of_last))))
            shade_three<depth>(strips[first], strips[middle], strips[last], hn::RebindMask(d, of_middle),
                               hn::RebindMask(d, of_last), n, K, values);
        else
            shade_several(words, strips, n, K, values);
    }
};

template <bool depth>
void shade_strips(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out) {
    const auto n_first = static_cast<float>(plane.first_column);
    const bool large = strips.size() * hn::Lanes(FloatTag()) <= plane.directions;
    if (large)
        shade_vectors(plane, out, ShadeStrips<depth, true>{strips.data(), n_first, plane.first_direction});
    else
        shade_vectors(plane, out, ShadeStrips<depth, false>{strips.data(), n_first, plane.first_direction});
}

void Shade(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out) {
    if (out.values[3])
        shade_strips<true>(plane, strips, out);
    else
        shade_strips<false>(plane, strips, out);
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::render::epi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::render::epi {

HWY_EXPORT(Shade);

void shade_scene(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out) {
    HWY_DYNAMIC_DISPATCH(Shade)(plane, strips, out);
}

}  // namespace hogel::render::epi
#endif
