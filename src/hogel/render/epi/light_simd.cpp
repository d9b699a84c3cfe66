// SPDX-License-Identifier: Apache-2.0
// The vector twin of epi_light.cpp, compiled for every instruction set and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/render/epi/light_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <bit>
#include <cmath>

#include "hogel/render/epi/light.h"
#include "hogel/render/epi/samples.h"
#include "hogel/render/sample_store.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void ShadeLit(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
              const SampleSource& samples, const ShadedPlane& out) {
    shade_lit_plain(plane, strips, lit, samples, out);
}
#else
// Vectors of samples of a plane, column by column. Where the nodes of a column's samples lie is worked out for all of
// them before any is loaded, or else each vector would wait for it.
class LitSamples {
  public:
    LitSamples(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
               const SampleSource& samples, const ShadedPlane& out, std::uint32_t* offsets, float* beyonds)
        : plane_(plane),
          strips_(strips.data()),
          lit_(lit),
          samples_(samples),
          colour_(out.values[1] != nullptr),
          depth_(out.values[3] != nullptr),
          offsets_(offsets),
          beyonds_(beyonds) {}

    HWY_INLINE void begin(std::size_t column) const {
        const FloatTag d;
        const NumberTag du;
        const LitStrips::Line* lines = lit_.lines();
        const Floats n = hn::Set(d, static_cast<float>(plane_.first_column) + static_cast<float>(column));
        const std::uint64_t* words = plane_.words + column * plane_.directions;
        // What is read beyond the column is of the next, or spare.
        for (std::size_t k = 0; k < plane_.directions; k += hn::Lanes(d), words += hn::Lanes(d)) {
            const Floats K = hn::Iota(d, plane_.first_direction + static_cast<float>(k));
            const Numbers numbers = numbers_of(words);
            const auto first = static_cast<std::uint32_t>(words[0]);
            Floats place[4], line[4];
            if (!hn::AllTrue(du, hn::Eq(numbers, hn::Set(du, first)))) {
                const float* from[hn::MaxLanes(FloatTag())];
                for (std::size_t i = 0; i < hn::MaxLanes(d); ++i) from[i] = &lines[words[i] & 0xffffffff].x0;
                for (std::size_t i = 0; i < 4; ++i) {
                    place[i] = load_blocks(from + i, 0);
                    line[i] = load_blocks(from + i, 4);
                }
                transpose(place);
                transpose(line);
            } else {
                const float* from = &lines[first].x0;
                for (std::size_t i = 0; i < 4; ++i) {
                    place[i] = hn::Set(d, from[i]);
                    line[i] = hn::Set(d, from[4 + i]);
                }
            }
            const Floats at = hn::Mul(parts_of_strips(n, K, place), line[1]);
            const Floats to_whole = hn::Set(d, shading::LightGrid::to_whole);
            const Floats rounded = hn::Add(hn::Min(hn::Sub(at, hn::Set(d, 0.5f)), line[2]), to_whole);
            hn::Store(hn::Sub(at, hn::Sub(rounded, to_whole)), d, beyonds_ + k);
            hn::Store(hn::ShiftLeft<4>(hn::Add(hn::BitCast(du, line[0]), hn::BitCast(du, rounded))), du, offsets_ + k);
        }
    }

    // The first in column and direction k, and what their words say.
    HWY_INLINE void operator()(const std::uint64_t* words, std::size_t column, std::size_t k,
                               Floats (&values)[4]) const {
        const FloatTag d;
        const NumberTag du;
        interpolate(k, values);
        // Unmade nodes have no depth.
        if (HWY_UNLIKELY(!hn::AllFalse(d, hn::IsNaN(values[3])))) {
            // A copy, so that values can stay in registers.
            Floats some[4] = {values[0], values[1], values[2], values[3]};
            shade_slowly(words, column, k, some);
            for (int i = 0; i < 4; ++i) values[i] = some[i];
        }
        if (!depth_) return;
        const auto nobody = hn::RebindMask(d, hn::Eq(numbers_of(words), hn::Set(du, EpipolarPlane::nobody)));
        values[3] = hn::IfThenElse(nobody, hn::Set(d, strips_[EpipolarPlane::nobody].value0[3]), values[3]);
    }

  private:
    HWY_INLINE void interpolate(std::size_t k, Floats (&values)[4]) const {
        const FloatTag d;
        const NumberTag du;
        const auto* nodes = reinterpret_cast<const char*>(lit_.nodes());
        const std::uint32_t* offsets = offsets_ + k;
        const Floats beyond = hn::Load(d, beyonds_ + k);
        const auto node = [nodes](std::uint32_t offset, std::size_t behind)
                              HWY_ATTR { return reinterpret_cast<const float*>(nodes + offset) + behind; };
        if (hn::AllTrue(du, hn::Eq(hn::Load(du, offsets), hn::Set(du, offsets[0])))) {
            const float* here = node(offsets[0], 0);
            for (std::size_t i = 0; i < 4; ++i) {
                const Floats from = hn::Set(d, here[i]);
                values[i] = hn::Add(from, hn::Mul(beyond, hn::Sub(hn::Set(d, here[4 + i]), from)));
            }
            return;
        }
        const auto interpolated = [&](std::size_t i, Floats part) HWY_ATTR {
            const Floats here = load_blocks([=](std::size_t k) { return node(offsets[i + k], 0); }),
                         next = load_blocks([=](std::size_t k) { return node(offsets[i + k], 4); });
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
        return bits_of(FloatTag(), hn::IsNaN(values[3]));
    }

    // Makes the nodes that are missing, and asks for the samples that have none.
    HWY_NOINLINE void shade_slowly(const std::uint64_t* words, std::size_t column, std::size_t k,
                                   Floats (&values)[4]) const {
        const FloatTag d;
        constexpr std::size_t lanes = hn::MaxLanes(FloatTag());
        static_assert(lanes <= 16);
        HWY_ALIGN float value[4][lanes];
        const float n = static_cast<float>(plane_.first_column) + static_cast<float>(column);
        const auto part_of = [&](std::size_t i) {
            return part_of_strip(strips_[words[i] & 0xffffffff], n, plane_.first_direction + static_cast<float>(k + i));
        };
        for (std::uint64_t rest = lanes_without_depth(values); rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const std::size_t number = words[i] & 0xffffffff;
            if (lit_.lines()[number].from == LightFrom::points)
                make_nodes_around(part_of(i), number, strips_[number], lit_, samples_, colour_);
        }
        interpolate(k, values);
        std::uint64_t rest = lanes_without_depth(values);
        if (rest == 0) return;
        for (int i = 0; i < 4; ++i) hn::Store(values[i], d, value[i]);
        for (; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const std::size_t number = words[i] & 0xffffffff;
            // A lane beyond the column, where begin() saw the next one.
            if (number == EpipolarPlane::nobody) continue;
            const float part = part_of(i);
            const Rgb radiance = samples_.radiance(number, part, column, k + i);
            value[0][i] = colour_ ? radiance.r : luminance(radiance);
            value[1][i] = radiance.g;
            value[2][i] = radiance.b;
            value[3][i] = strips_[number].value0[3] + part * strips_[number].difference[3];
        }
        for (int i = 0; i < 4; ++i) values[i] = hn::Load(d, value[i]);
    }

    const EpipolarPlane& plane_;
    const StripShades* strips_;
    LitStrips& lit_;
    const SampleSource& samples_;
    bool colour_, depth_;
    std::uint32_t* offsets_;  // of a column: bytes before the first node of each sample
    float* beyonds_;          // and how far it lies on from there, in cells
};

void ShadeLit(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
              const SampleSource& samples, const ShadedPlane& out) {
    make_nodes_of_seen({plane.words, plane.columns * plane.directions}, strips, lit, samples, out.values[1] != nullptr);
    thread_local std::vector<std::uint32_t, CacheLineAllocator<std::uint32_t> > offsets;
    thread_local std::vector<float, CacheLineAllocator<float> > beyonds;
    constexpr std::size_t lanes = hn::MaxLanes(FloatTag());
    offsets.resize(plane.directions + lanes);
    beyonds.resize(plane.directions + lanes);
    shade_vectors(plane, out, LitSamples(plane, strips, lit, samples, out, offsets.data(), beyonds.data()));
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::render::epi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::render::epi {

HWY_EXPORT(ShadeLit);

void shade_lit(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
               const SampleSource& samples, const ShadedPlane& out) {
    HWY_DYNAMIC_DISPATCH(ShadeLit)(plane, strips, lit, samples, out);
}

}  // namespace hogel::render::epi
#endif
