// SPDX-License-Identifier: Apache-2.0
// Vector version of shade_between_knots_plain in shaded_spans.cpp for every SIMD target.
#include <bit>
#include <cmath>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/render/epi/shaded_spans.h"
#include "hogel/render/epi/shading_lanes.h"
#include "hogel/render/sample_store.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void ShadeBetweenKnots(const EpipolarPlane& plane, std::span<const SpanValues> values, ShadedSpans& spans,
                       const RadianceSource& source, const PlaneOutput& out) {
    shade_between_knots_plain(plane, values, spans, source, out);
}
#else
// Shades vectors of samples, column by column. The knot positions of all samples of a column are computed before any
// knot is loaded; otherwise each vector would wait for its own.
class KnotShading {
  public:
    KnotShading(const EpipolarPlane& plane, std::span<const SpanValues> span_values, ShadedSpans& spans,
                const RadianceSource& source, const PlaneOutput& out, std::uint32_t* offsets, float* fractions)
        : plane_(plane),
          span_values_(span_values.data()),
          spans_(spans),
          source_(source),
          colour_(out.values[1] != nullptr),
          depth_(out.values[3] != nullptr),
          offsets_(offsets),
          fractions_(fractions) {}

    // Computes the knot positions of a column's samples.
    HWY_INLINE void begin(std::size_t column) const {
        const FloatTag d;
        const NumberTag du;
        const ShadedSpans::Span* spans = spans_.spans();
        const Floats n = hn::Set(d, static_cast<float>(plane_.first_column) + static_cast<float>(column));
        const std::uint64_t* words = plane_.words + column * plane_.directions;
        // The last vector may read words of the next column, or padding.
        for (std::size_t k = 0; k < plane_.directions; k += hn::Lanes(d), words += hn::Lanes(d)) {
            const Floats K = hn::Iota(d, plane_.first_direction + static_cast<float>(k));
            const Numbers numbers = numbers_of(words);
            const auto first = static_cast<std::uint32_t>(words[0]);
            Floats ends[4], knots[4];
            if (!hn::AllTrue(du, hn::Eq(numbers, hn::Set(du, first)))) {
                const float* sources[hn::MaxLanes(FloatTag())];
                for (std::size_t i = 0; i < hn::MaxLanes(d); ++i) sources[i] = &spans[words[i] & 0xffffffff].x0;
                for (std::size_t i = 0; i < 4; ++i) {
                    ends[i] = load_blocks(sources + i, 0);
                    knots[i] = load_blocks(sources + i, 4);
                }
                transpose(ends);
                transpose(knots);
            } else {
                const float* sources = &spans[first].x0;
                for (std::size_t i = 0; i < 4; ++i) {
                    ends[i] = hn::Set(d, sources[i]);
                    knots[i] = hn::Set(d, sources[4 + i]);
                }
            }
            // ShadedSpans::Interval.
            const auto& [base, intervals, limit, unused] = knots;
            const Floats scaled = hn::Mul(positions_on_spans(n, K, ends), intervals);
            const Floats to_whole = hn::Set(d, shading::LightGrid::to_whole);
            const Floats rounded = hn::Add(hn::Min(hn::Sub(scaled, hn::Set(d, 0.5f)), limit), to_whole);
            hn::Store(hn::Sub(scaled, hn::Sub(rounded, to_whole)), d, fractions_ + k);
            hn::Store(hn::ShiftLeft<4>(hn::Add(hn::BitCast(du, base), hn::BitCast(du, rounded))), du, offsets_ + k);
        }
    }

    // Shades the samples of these words; the first is in direction k of a column (shade_vectors).
    HWY_INLINE void operator()(const std::uint64_t* words, std::size_t column, std::size_t k,
                               Floats (&values)[4]) const {
        const FloatTag d;
        const NumberTag du;
        interpolate(k, values);
        // Pending knots have no depth.
        if (HWY_UNLIKELY(!hn::AllFalse(d, hn::IsNaN(values[3])))) {
            // Copied so that `values` can stay in registers.
            Floats copy[4] = {values[0], values[1], values[2], values[3]};
            shade_pending(words, column, k, copy);
            for (int i = 0; i < 4; ++i) values[i] = copy[i];
        }
        if (!depth_) return;
        const auto background = hn::RebindMask(d, hn::Eq(numbers_of(words), hn::Set(du, EpipolarPlane::background)));
        const Floats background_depth = hn::Set(d, span_values_[EpipolarPlane::background].value0[3]);
        values[3] = hn::IfThenElse(background, background_depth, values[3]);
    }

  private:
    HWY_INLINE void interpolate(std::size_t k, Floats (&values)[4]) const {
        const FloatTag d;
        const NumberTag du;
        const auto* knots = reinterpret_cast<const char*>(spans_.knots());
        const std::uint32_t* offsets = offsets_ + k;
        const Floats fraction = hn::Load(d, fractions_ + k);
        const auto knot = [knots](std::uint32_t offset, std::size_t i)
                              HWY_ATTR { return reinterpret_cast<const float*>(knots + offset) + i; };
        if (hn::AllTrue(du, hn::Eq(hn::Load(du, offsets), hn::Set(du, offsets[0])))) {
            const float* first_knot = knot(offsets[0], 0);
            for (std::size_t i = 0; i < 4; ++i) {
                const Floats start = hn::Set(d, first_knot[i]);
                values[i] = hn::Add(start, hn::Mul(fraction, hn::Sub(hn::Set(d, first_knot[4 + i]), start)));
            }
            return;
        }
        const auto interpolated = [&](std::size_t i, Floats fractions) HWY_ATTR {
            const Floats first_knot = load_blocks([=](std::size_t lane) { return knot(offsets[i + lane], 0); }),
                         next = load_blocks([=](std::size_t lane) { return knot(offsets[i + lane], 4); });
            return hn::Add(first_knot, hn::Mul(fractions, hn::Sub(next, first_knot)));
        };
        values[0] = interpolated(0, hn::Broadcast<0>(fraction));
        values[1] = interpolated(1, hn::Broadcast<1>(fraction));
        values[2] = interpolated(2, hn::Broadcast<2>(fraction));
        values[3] = interpolated(3, hn::Broadcast<3>(fraction));
        transpose(values);
    }

    static HWY_INLINE std::uint64_t pending_lanes(const Floats (&values)[4]) {
        return bits_of(FloatTag(), hn::IsNaN(values[3]));
    }

    // Fills the pending knots of a vector of samples, and evaluates the samples of spans without knots.
    HWY_NOINLINE void shade_pending(const std::uint64_t* words, std::size_t column, std::size_t k,
                                    Floats (&values)[4]) const {
        const FloatTag d;
        constexpr std::size_t lanes = hn::MaxLanes(FloatTag());
        static_assert(lanes <= 16);
        HWY_ALIGN float value[4][lanes];
        const float n = static_cast<float>(plane_.first_column) + static_cast<float>(column);
        const auto position_of = [&](std::size_t i) {
            return position_on_span(span_values_[words[i] & 0xffffffff], n,
                                    plane_.first_direction + static_cast<float>(k + i));
        };
        for (std::uint64_t remaining = pending_lanes(values); remaining != 0; remaining &= remaining - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(remaining));
            const std::size_t number = words[i] & 0xffffffff;
            if (spans_.spans()[number].from == RadianceFrom::cache)
                fill_knots_around(position_of(i), number, span_values_[number], spans_, source_, colour_);
        }
        interpolate(k, values);
        std::uint64_t remaining = pending_lanes(values);
        if (remaining == 0) return;
        for (int i = 0; i < 4; ++i) hn::Store(values[i], d, value[i]);
        for (; remaining != 0; remaining &= remaining - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(remaining));
            const std::size_t number = words[i] & 0xffffffff;
            // This lane is beyond the column's end, where begin() read the next column.
            if (number == EpipolarPlane::background) continue;
            const float position = position_of(i);
            const Rgb radiance = source_.radiance(number, position, column, k + i);
            value[0][i] = colour_ ? radiance.r : luminance(radiance);
            value[1][i] = radiance.g;
            value[2][i] = radiance.b;
            value[3][i] = span_values_[number].value0[3] + position * span_values_[number].difference[3];
        }
        for (int i = 0; i < 4; ++i) values[i] = hn::Load(d, value[i]);
    }

    const EpipolarPlane& plane_;
    const SpanValues* span_values_;
    ShadedSpans& spans_;
    const RadianceSource& source_;
    bool colour_, depth_;
    // Offset in bytes of the preceding knot, and Interval::fraction, of each sample of a column.
    std::uint32_t* offsets_;
    float* fractions_;
};

void ShadeBetweenKnots(const EpipolarPlane& plane, std::span<const SpanValues> values, ShadedSpans& spans,
                       const RadianceSource& source, const PlaneOutput& out) {
    fill_visible_knots({plane.words, plane.columns * plane.directions}, values, spans, source,
                       out.values[1] != nullptr);
    constexpr std::size_t lanes = hn::MaxLanes(FloatTag());
    const core::ThreadBuffer<std::uint32_t> offsets(plane.directions + lanes);
    const core::ThreadBuffer<float> fractions(plane.directions + lanes);
    shade_vectors(plane, out, KnotShading(plane, values, spans, source, out, offsets.data(), fractions.data()));
}
#endif

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::render::epi {
HOGEL_DISPATCH(shade_between_knots, ShadeBetweenKnots);
}  // namespace hogel::render::epi
