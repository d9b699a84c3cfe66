// SPDX-License-Identifier: Apache-2.0
// Vector version of shade_between_ends_plain in kernels.cpp for every SIMD target.
#include <bit>
#include <cstddef>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/shading_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void ShadeBetweenEnds(const EpipolarPlane& plane, std::span<const SpanValues> spans, const PlaneOutput& out) {
    shade_between_ends_plain(plane, spans, out);
}
#else
using FloatMask = hn::Mask<FloatTag>;

// SpanValues of a vector of samples. Block b (four lanes) of vector i in each array holds the values of sample 4 b + i.
struct ValueBlocks {
    Floats ends[4], value0[4], difference[4];
};

// Loads whole cache lines if a vector has that size, because a load of a whole line takes no longer than one of a part.
HWY_INLINE void load_values(const SpanValues* const* spans, ValueBlocks& blocks) {
    const FloatTag d;
#if HWY_MAX_BYTES >= 64
    const NumberTag du;
    if constexpr (hn::MaxLanes(d) == 16) {
        const auto odd = hn::RebindMask(d, hn::Ne(hn::And(hn::Iota(du, 0), hn::Set(du, 4)), hn::Zero(du)));
        for (std::size_t i = 0; i < 4; ++i) {
            const Floats a = hn::Load(d, &spans[i]->x0), b = hn::Load(d, &spans[i + 4]->x0),
                         c = hn::Load(d, &spans[i + 8]->x0), e = hn::Load(d, &spans[i + 12]->x0);
            // The blocks of each are ends, value0, difference, and an unused one.
            const Floats ac = hn::ConcatLowerLower(d, c, a), be = hn::ConcatLowerLower(d, e, b);
            blocks.ends[i] = hn::IfThenElse(odd, hn::SwapAdjacentBlocks(be), ac);
            blocks.value0[i] = hn::IfThenElse(odd, be, hn::SwapAdjacentBlocks(ac));
            blocks.difference[i] = hn::IfThenElse(odd, hn::SwapAdjacentBlocks(hn::ConcatUpperUpper(d, e, b)),
                                                  hn::ConcatUpperUpper(d, c, a));
        }
        return;
    }
#endif
    const float* sources[hn::MaxLanes(d)];
    for (std::size_t i = 0; i < hn::MaxLanes(d); ++i) sources[i] = &spans[i]->x0;
    for (std::size_t i = 0; i < 4; ++i) {
        blocks.ends[i] = load_blocks(sources + i, 0);
        blocks.value0[i] = load_blocks(sources + i, 4);
        blocks.difference[i] = load_blocks(sources + i, 8);
    }
}

// Computes the values of samples of any number of spans.
HWY_INLINE void shade_several(const std::uint64_t* words, const SpanValues* spans, Floats n, Floats K,
                              Floats (&values)[4]) {
    const SpanValues* visible[hn::MaxLanes(FloatTag())];
    for (std::size_t i = 0; i < hn::MaxLanes(FloatTag()); ++i) visible[i] = &spans[words[i] & 0xffffffff];
    ValueBlocks blocks;
    load_values(visible, blocks);
    transpose(blocks.ends);
    const Floats position = positions_on_spans(n, K, blocks.ends);
    const auto value = [&](std::size_t i, Floats positions)
                           HWY_ATTR { return hn::Add(blocks.value0[i], hn::Mul(positions, blocks.difference[i])); };
    values[0] = value(0, hn::Broadcast<0>(position));
    values[1] = value(1, hn::Broadcast<1>(position));
    values[2] = value(2, hn::Broadcast<2>(position));
    values[3] = value(3, hn::Broadcast<3>(position));
    transpose(values);
}

// Computes samples of up to three spans: the last and the middle one in these lanes, the first in all others.
template <bool depth>
HWY_INLINE void shade_three(const SpanValues& first, const SpanValues& middle, const SpanValues& last,
                            FloatMask in_middle, FloatMask in_last, Floats n, Floats K, Floats (&values)[4]) {
    const FloatTag d;
    const auto in_lanes = [&](const float& a, const float& b, const float& c) HWY_ATTR {
        return hn::IfThenElse(in_last, hn::Set(d, c), hn::IfThenElse(in_middle, hn::Set(d, b), hn::Set(d, a)));
    };
    const Floats position =
        positions_on_spans(n, K,
                           {in_lanes(first.x0, middle.x0, last.x0), in_lanes(first.z0, middle.z0, last.z0),
                            in_lanes(first.dx, middle.dx, last.dx), in_lanes(first.dz, middle.dz, last.dz)});
    for (int i = 0; i < (depth ? 4 : 3); ++i)
        values[i] = hn::Add(in_lanes(first.value0[i], middle.value0[i], last.value0[i]),
                            hn::Mul(position, in_lanes(first.difference[i], middle.difference[i], last.difference[i])));
}

template <bool depth>
HWY_INLINE void shade_one(const SpanValues& span, Floats n, Floats K, Floats (&values)[4]) {
    const FloatTag d;
    const Floats position = positions_on_one(span, n, K);
    for (int i = 0; i < (depth ? 4 : 3); ++i)
        values[i] = hn::Add(hn::Set(d, span.value0[i]), hn::Mul(position, hn::Set(d, span.difference[i])));
}

// Shades a vector of samples. Whether it sees one, two or three spans is unpredictable, so these cases share one path,
// unless most spans are `large`. (A class, because lambdas that are called twice are not inlined.)
template <bool depth, bool large>
struct ShadeVector {
    const SpanValues* spans;
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
        const auto in_first = hn::Eq(numbers, hn::Set(du, first)), in_last = hn::Eq(numbers, hn::Set(du, last));
        const std::uint64_t others = bits_of(du, hn::Not(hn::Or(in_first, in_last)));
        if ((large || first == EpipolarPlane::background) && others == 0 && last == first) {
            if (large && first != EpipolarPlane::background)
                shade_one<depth>(spans[first], n, K, values);
            else
                for (int i = 0; i < 4; ++i) values[i] = hn::Set(d, spans[EpipolarPlane::background].value0[i]);
            return;
        }
        // A span other than the first and the last, or the last if there is no other.
        const std::uint64_t others_or_last = others | std::uint64_t{1} << (lanes - 1);
        const auto middle = static_cast<std::uint32_t>(words[std::countr_zero(others_or_last)]);
        const auto in_middle = hn::Eq(numbers, hn::Set(du, middle));
        if (hn::AllTrue(du, hn::Or(in_middle, hn::Or(in_first, in_last))))
            shade_three<depth>(spans[first], spans[middle], spans[last], hn::RebindMask(d, in_middle),
                               hn::RebindMask(d, in_last), n, K, values);
        else
            shade_several(words, spans, n, K, values);
    }
};

template <bool depth>
void shade_plane(const EpipolarPlane& plane, std::span<const SpanValues> spans, const PlaneOutput& out) {
    const auto n_first = static_cast<float>(plane.first_column);
    const bool large = spans.size() * hn::Lanes(FloatTag()) <= plane.directions;
    if (large)
        shade_vectors(plane, out, ShadeVector<depth, true>{spans.data(), n_first, plane.first_direction});
    else
        shade_vectors(plane, out, ShadeVector<depth, false>{spans.data(), n_first, plane.first_direction});
}

void ShadeBetweenEnds(const EpipolarPlane& plane, std::span<const SpanValues> spans, const PlaneOutput& out) {
    if (out.values[3])
        shade_plane<true>(plane, spans, out);
    else
        shade_plane<false>(plane, spans, out);
}
#endif

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::render::epi {
HOGEL_DISPATCH(shade_between_ends, ShadeBetweenEnds);
}  // namespace hogel::render::epi
