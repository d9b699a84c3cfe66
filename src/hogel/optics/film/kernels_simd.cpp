// SPDX-License-Identifier: Apache-2.0
// The vector twins of kernels.cpp, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/optics/film/kernels_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

#include <cstdint>

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

// Cubic interpolation at positions among `size` samples; gather(i) loads sample i of each lane. Positions are doubles,
// because a film is wide and positions must be accurate to a thousandth of a sample.
template <class Gather>
HWY_INLINE hn::Vec<Floats> cubic(hn::Vec<Doubles> place, std::size_t size, const Gather& gather) {
    const Doubles dd;
    const Floats df;
    const Indices di;
    const auto whole = hn::Floor(place);
    const auto inside = hn::And(hn::Ge(whole, hn::Set(dd, 1)), hn::Lt(whole, hn::Set(dd, double(size) - 2)));
    const auto x = hn::DemoteTo(df, hn::IfThenElseZero(inside, hn::Sub(place, whole)));
    const auto at = hn::DemoteTo(di, hn::IfThenElse(inside, whole, hn::Set(dd, 1)));
    const auto one = hn::Set(di, 1);
    const auto a = gather(hn::Sub(at, one)), b = gather(at), c = gather(hn::Add(at, one)),
               d = gather(hn::Add(at, hn::Set(di, 2)));
    // b + x/2 · ((c − a) + x ((2a − 5b + 4c − d) + x (3(b − c) + d − a)))
    const auto third = hn::Add(hn::Mul(hn::Set(df, 3), hn::Sub(b, c)), hn::Sub(d, a));
    const auto second =
        hn::Sub(hn::MulAdd(hn::Set(df, 4), c, hn::Mul(hn::Set(df, 2), a)), hn::MulAdd(hn::Set(df, 5), b, d));
    const auto slope = hn::MulAdd(x, hn::MulAdd(x, third, second), hn::Sub(c, a));
    const auto value = hn::MulAdd(hn::Mul(hn::Set(df, 0.5f), x), slope, b);
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
    const std::size_t vectors = height < 3 || stride > INT32_MAX / height ? 0 : out.size() / lanes;
    const auto row = hn::Set(di, static_cast<std::int32_t>(vectors == 0 ? 0 : stride));
    for (std::size_t v = 0; v < vectors; ++v) {
        const std::size_t i = v * lanes;
        const auto place =
            hn::MulAdd(hn::LoadU(dd, &places.slopes[i]), hn::Set(dd, places.scale), hn::Set(dd, places.offset));
        const auto column = hn::Iota(di, static_cast<std::int32_t>(i));
        const auto value = cubic(place, height, [&](hn::Vec<Indices> j) {
            return hn::GatherIndex(df, values, hn::Add(hn::Mul(j, row), column));
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
    const std::size_t lanes = hn::Lanes(dd), vectors = line.size() < 3 ? 0 : out.size() / lanes;
    const auto steps = hn::Iota(dd, 0);
    for (std::size_t v = 0; v < vectors; ++v) {
        const std::size_t k = v * lanes;
        const auto d =
            hn::MulAdd(hn::Add(steps, hn::Set(dd, double(k))), hn::Set(dd, places.pitch), hn::Set(dd, places.first));
        const auto square = hn::MulAdd(d, d, hn::Set(dd, places.square));
        const auto r = hn::Sqrt(square);
        const auto place = hn::MulAdd(hn::Div(d, r), hn::Set(dd, places.scale), hn::Set(dd, places.offset));
        const auto value =
            cubic(place, line.size(), [&](hn::Vec<Indices> i) { return hn::GatherIndex(df, line.data(), i); });
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
