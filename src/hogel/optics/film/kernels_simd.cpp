// SPDX-License-Identifier: Apache-2.0
// The vector twins of kernels.cpp, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/optics/film/kernels_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

#include <cstdint>

#include "hogel/optics/film/interpolation.h"
#include "hogel/optics/film/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::optics::film {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void AddDownColumns(const float* values, std::size_t stride, std::size_t height, const ColumnPlaces& places,
                    float weight, std::span<float> out) {
    add_down_columns_plain(values, stride, height, places, weight, out);
}

void AddAlongLine(std::span<const float> line, const LinePlaces& places, float weight, std::span<float> out) {
    add_along_line_plain(line, places, weight, out);
}
#else
using Doubles = hn::ScalableTag<double>;
using Floats = hn::Rebind<float, Doubles>;
using Indices = hn::Rebind<std::int32_t, Doubles>;

// TwelvePoint interpolation at positions among `size` samples; gather(i) loads sample i of each lane. Positions are
// doubles, because a film is wide and positions must be accurate to a thousandth of a sample. Each power of the place
// has a sum of the samples, so that no weight is computed.
template <class Gather>
HWY_INLINE hn::Vec<Floats> twelve_points(hn::Vec<Doubles> place, std::size_t size, const Gather& gather) {
    const Doubles dd;
    const Floats df;
    const Indices di;
    constexpr double before = TwelvePoint::before;
    const auto whole = hn::Floor(place);
    const auto inside =
        hn::And(hn::Ge(whole, hn::Set(dd, before)), hn::Lt(whole, hn::Set(dd, double(size) - TwelvePoint::after)));
    const auto z = hn::DemoteTo(df, hn::Sub(hn::IfThenElseZero(inside, hn::Sub(place, whole)), hn::Set(dd, 0.5)));
    const auto first = hn::DemoteTo(di, hn::IfThenElse(inside, hn::Sub(whole, hn::Set(dd, before)), hn::Zero(dd)));
    hn::Vec<Floats> values[TwelvePoint::taps];
    gather(first, values);
    const auto& c = TwelvePoint::table().coefficients();
    auto value = hn::Zero(df);
    for (std::size_t p = TwelvePoint::terms; p-- > 0;) {
        auto sum = hn::Mul(hn::Set(df, c[p][0]), values[0]);
        for (std::size_t k = 1; k < TwelvePoint::taps; ++k) sum = hn::MulAdd(hn::Set(df, c[p][k]), values[k], sum);
        value = hn::MulAdd(value, z, sum);
    }
    const auto one_where_inside = hn::DemoteTo(df, hn::IfThenElseZero(inside, hn::Set(dd, 1)));
    return hn::Mul(value, one_where_inside);
}

void AddDownColumns(const float* values, std::size_t stride, std::size_t height, const ColumnPlaces& places,
                    float weight, std::span<float> out) {
    const Doubles dd;
    const Floats df;
    const Indices di;
    const std::size_t lanes = hn::Lanes(dd);
    // Indices of a gather have 32 bits.
    const std::size_t vectors = height < TwelvePoint::taps || stride > INT32_MAX / height ? 0 : out.size() / lanes;
    const auto row = hn::Set(di, static_cast<std::int32_t>(vectors == 0 ? 0 : stride));
    for (std::size_t v = 0; v < vectors; ++v) {
        const std::size_t i = v * lanes;
        const auto place =
            hn::MulAdd(hn::LoadU(dd, &places.slopes[i]), hn::Set(dd, places.scale), hn::Set(dd, places.offset));
        const auto column = hn::Iota(di, static_cast<std::int32_t>(i));
        const auto value = twelve_points(place, height, [&](hn::Vec<Indices> j, hn::Vec<Floats>* samples) {
            // Neighbouring columns nearly always have the same rows.
            const std::int32_t top = hn::GetLane(j);
            if (hn::AllTrue(di, hn::Eq(j, hn::Set(di, top)))) {
                const float* from = values + static_cast<std::size_t>(top) * stride + i;
                for (std::size_t k = 0; k < TwelvePoint::taps; ++k) samples[k] = hn::LoadU(df, from + k * stride);
                return;
            }
            auto at = hn::Add(hn::Mul(j, row), column);
            for (std::size_t k = 0; k < TwelvePoint::taps; ++k, at = hn::Add(at, row))
                samples[k] = hn::GatherIndex(df, values, at);
        });
        hn::StoreU(hn::MulAdd(hn::Set(df, weight), value, hn::LoadU(df, &out[i])), df, &out[i]);
    }
    const std::size_t done = vectors * lanes;
    if (done < out.size())
        add_down_columns_plain(values + done, stride, height,
                               {places.slopes.subspan(done), places.scale, places.offset}, weight, out.subspan(done));
}

void AddAlongLine(std::span<const float> line, const LinePlaces& places, float weight, std::span<float> out) {
    const Doubles dd;
    const Floats df;
    const Indices di;
    const std::size_t lanes = hn::Lanes(dd), vectors = line.size() < TwelvePoint::taps ? 0 : out.size() / lanes;
    const auto steps = hn::Iota(dd, 0);
    for (std::size_t v = 0; v < vectors; ++v) {
        const std::size_t k = v * lanes;
        const auto d =
            hn::MulAdd(hn::Add(steps, hn::Set(dd, double(k))), hn::Set(dd, places.pitch), hn::Set(dd, places.first));
        const auto square = hn::MulAdd(d, d, hn::Set(dd, places.square));
        const auto r = hn::Sqrt(square);
        const auto place = hn::MulAdd(hn::Div(d, r), hn::Set(dd, places.scale), hn::Set(dd, places.offset));
        const auto value = twelve_points(place, line.size(), [&](hn::Vec<Indices> at, hn::Vec<Floats>* samples) {
            for (std::size_t t = 0; t < TwelvePoint::taps; ++t, at = hn::Add(at, hn::Set(di, 1)))
                samples[t] = hn::GatherIndex(df, line.data(), at);
        });
        const auto factor = hn::Mul(hn::DemoteTo(df, hn::Mul(square, r)), hn::Set(df, weight));
        hn::StoreU(hn::MulAdd(factor, hn::Max(value, hn::Zero(df)), hn::LoadU(df, &out[k])), df, &out[k]);
    }
    const std::size_t done = vectors * lanes;
    if (done == out.size()) return;
    LinePlaces rest = places;
    rest.first += places.pitch * static_cast<double>(done);
    add_along_line_plain(line, rest, weight, out.subspan(done));
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::optics::film
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::optics::film {

HWY_EXPORT(AddDownColumns);
HWY_EXPORT(AddAlongLine);

void add_down_columns(const float* values, std::size_t stride, std::size_t height, const ColumnPlaces& places,
                      float weight, std::span<float> out) {
    HWY_DYNAMIC_DISPATCH(AddDownColumns)(values, stride, height, places, weight, out);
}

void add_along_line(std::span<const float> line, const LinePlaces& places, float weight, std::span<float> out) {
    HWY_DYNAMIC_DISPATCH(AddAlongLine)(line, places, weight, out);
}

}  // namespace hogel::optics::film
#endif
