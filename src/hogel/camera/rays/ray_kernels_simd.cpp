// SPDX-License-Identifier: Apache-2.0
// Vector twins of ray_kernels.cpp, compiled for every SIMD target and chosen when first called.
#include "hogel/camera/rays/ray_kernels.h"
#include "hogel/core/simd_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::rays::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Indices = hn::ScalableTag<std::int32_t>;
using Value = hn::Vec<Floats>;

// Multiplies and adds separately, so that the bytes are those of the plain twins.
HWY_INLINE Value mix(Value a, Value b, Value weight) { return hn::Add(a, hn::Mul(hn::Sub(b, a), weight)); }

HWY_INLINE LinePositions remainder_of(const LinePositions& positions, std::size_t done) {
    return {positions.low.subspan(done), positions.high_weight.subspan(done)};
}

void SampleBetween(const HogelRows& hogels, const LinePositions& directions, std::span<float> out) {
    const Floats df;
    const Indices di;
    const std::size_t lanes = hn::Lanes(df);
    // A gather has 32-bit indices; a hogel's own offset is below its size.
    const std::size_t vectors = hogels.hogel > INT32_MAX / (lanes + 1) ? 0 : out.size() / lanes;
    const auto from_hogel =
        hn::Mul(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(vectors ? hogels.hogel : 0)));
    const auto next = hn::Set(di, static_cast<std::int32_t>(hogels.next));
    const auto bottom_weight = hn::Set(df, hogels.bottom_weight);
    for (std::size_t v = 0; v < vectors; ++v) {
        const std::size_t i = v * lanes;
        const float* top = hogels.top + i * hogels.hogel;
        const float* bottom = hogels.bottom + i * hogels.hogel;
        const auto low = hn::Add(from_hogel, hn::LoadU(di, &directions.low[i])), high = hn::Add(low, next);
        const auto weight = hn::LoadU(df, &directions.high_weight[i]);
        const auto above = mix(hn::GatherIndex(df, top, low), hn::GatherIndex(df, top, high), weight);
        const auto below = mix(hn::GatherIndex(df, bottom, low), hn::GatherIndex(df, bottom, high), weight);
        hn::StoreU(mix(above, below, bottom_weight), df, &out[i]);
    }
    const std::size_t done = vectors * lanes;
    if (done == out.size()) return;
    HogelRows remainder = hogels;
    remainder.top += done * hogels.hogel;
    remainder.bottom += done * hogels.hogel;
    sample_between_plain(remainder, remainder_of(directions, done), out.subspan(done));
}

template <class Sample>
HWY_INLINE FourDirections<Sample> remainder_of(const FourDirections<Sample>& from, std::size_t done) {
    return {from.top_left + done, from.top_right + done, from.bottom_left + done, from.bottom_right + done};
}

template <class Sample, class Load>
HWY_INLINE void sample_along_loading(const FourDirections<Sample>& from, std::span<const float> right_weight,
                                     float bottom_weight, std::span<float> out, const Load& load) {
    const Floats df;
    const std::size_t lanes = hn::Lanes(df);
    const auto bottom = hn::Set(df, bottom_weight);
    std::size_t i = 0;
    for (; i + lanes <= out.size(); i += lanes) {
        const auto right = hn::LoadU(df, &right_weight[i]);
        const auto above = mix(load(from.top_left + i), load(from.top_right + i), right);
        const auto below = mix(load(from.bottom_left + i), load(from.bottom_right + i), right);
        hn::StoreU(mix(above, below, bottom), df, &out[i]);
    }
    sample_along_plain(remainder_of(from, i), right_weight.subspan(i), bottom_weight, out.subspan(i));
}

void LookAlong(const FourDirections<float>& from, std::span<const float> right_weight, float bottom_weight,
               std::span<float> out) {
    sample_along_loading(from, right_weight, bottom_weight, out,
                         [](const float* address) { return hn::LoadU(Floats(), address); });
}

void LookAlongHalves(const FourDirections<std::uint16_t>& from, std::span<const float> right_weight,
                     float bottom_weight, std::span<float> out) {
    sample_along_loading(from, right_weight, bottom_weight, out, [](const std::uint16_t* address) {
        const hn::Rebind<hwy::float16_t, Floats> dh;
        const hn::Rebind<std::uint16_t, Floats> du;
        return hn::PromoteTo(Floats(), hn::BitCast(dh, hn::LoadU(du, address)));
    });
}

void MixLines(std::span<const float> a, std::span<const float> b, float weight, std::span<float> out) {
    const Floats df;
    const std::size_t lanes = hn::Lanes(df);
    const auto weights = hn::Set(df, weight);
    std::size_t i = 0;
    for (; i + lanes <= out.size(); i += lanes)
        hn::StoreU(mix(hn::LoadU(df, &a[i]), hn::LoadU(df, &b[i]), weights), df, &out[i]);
    mix_lines_plain(a.subspan(i), b.subspan(i), weight, out.subspan(i));
}

void AddBetween(std::span<const float> line, std::size_t next, const LinePositions& positions, std::span<float> out) {
    const Floats df;
    const Indices di;
    const std::size_t lanes = hn::Lanes(df);
    std::size_t i = 0;
    for (; i + lanes <= out.size(); i += lanes) {
        const auto low = hn::LoadU(di, &positions.low[i]);
        const auto value = mix(hn::GatherIndex(df, line.data(), low), hn::GatherIndex(df, line.data() + next, low),
                               hn::LoadU(df, &positions.high_weight[i]));
        hn::StoreU(hn::Add(hn::LoadU(df, &out[i]), value), df, &out[i]);
    }
    add_between_plain(line, next, remainder_of(positions, i), out.subspan(i));
}

}  // namespace hogel::camera::rays::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::camera::rays {

HWY_EXPORT(LookAlong);
HWY_EXPORT(LookAlongHalves);

HOGEL_DISPATCH(sample_between, SampleBetween);

void sample_along(const FourDirections<float>& from, std::span<const float> right_weight, float bottom_weight,
                  std::span<float> out) {
    HWY_DYNAMIC_DISPATCH(LookAlong)(from, right_weight, bottom_weight, out);
}

void sample_along(const FourDirections<std::uint16_t>& from, std::span<const float> right_weight, float bottom_weight,
                  std::span<float> out) {
    HWY_DYNAMIC_DISPATCH(LookAlongHalves)(from, right_weight, bottom_weight, out);
}

HOGEL_DISPATCH(mix_lines, MixLines);
HOGEL_DISPATCH(add_between, AddBetween);

}  // namespace hogel::camera::rays
#endif
