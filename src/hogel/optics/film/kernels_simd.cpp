// SPDX-License-Identifier: Apache-2.0
// The vector twins of kernels.cpp, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/optics/film/kernels_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hogel/optics/film/interpolation.h"
#include "hogel/optics/film/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::optics::film {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void SumDownColumns(const float* values, std::size_t stride, std::size_t height, const ColumnPoints& points,
                    std::span<float> out) {
    sum_down_columns_plain(values, stride, height, points, out);
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

// The weights of all points of some neighbouring columns, on the rows from `first` on: at the least slope, in the
// middle and at the largest.
struct GroupWeights {
    std::size_t first = 0;
    std::vector<float> nodes[3];
    std::vector<double> scales_inside, scales_apart;  // those whose taps all exist at all three slopes, and others

    void set(const ColumnPoints& points, const double (&slopes)[3], std::size_t height) {
        constexpr double before = TwelvePoint::before, after = TwelvePoint::after;
        scales_inside.clear();
        scales_apart.clear();
        double low = static_cast<double>(height), high = 0;
        for (const double scale : points.scales) {
            const double a = std::floor(points.offset + scale * slopes[0]),
                         b = std::floor(points.offset + scale * slopes[2]);
            if (std::min(a, b) >= before && std::max(a, b) + after < static_cast<double>(height)) {
                scales_inside.push_back(scale);
                low = std::min({low, a, b});
                high = std::max({high, a, b});
            } else {
                scales_apart.push_back(scale);
            }
        }
        first = scales_inside.empty() ? 0 : static_cast<std::size_t>(low - before);
        const std::size_t taps = scales_inside.empty() ? 0 : static_cast<std::size_t>(high + after) - first + 1;
        for (std::size_t node = 0; node < 3; ++node) {
            nodes[node].assign(taps, 0.0f);
            for (const double scale : scales_inside) {
                const double place = points.offset + scale * slopes[node], whole = std::floor(place);
                const auto own = TwelvePoint::table().weights(static_cast<float>(place - whole) - 0.5f);
                float* to = &nodes[node][static_cast<std::size_t>(whole - before) - first];
                for (std::size_t k = 0; k < TwelvePoint::taps; ++k) to[k] += own[k];
            }
        }
        // They become those of the polynomial a + b t + c t², t = 0 … 1.
        for (std::size_t k = 0; k < taps; ++k) {
            const float start = nodes[0][k], middle = nodes[1][k], end = nodes[2][k];
            nodes[1][k] = -3 * start + 4 * middle - end;
            nodes[2][k] = 2 * start - 4 * middle + 2 * end;
        }
    }
};

// The most by which the place of a point may differ among columns that share weights, in rows.
constexpr double max_spread = 0.15;
constexpr std::size_t max_group = 64, min_group = 16;

void SumDownColumns(const float* values, std::size_t stride, std::size_t height, const ColumnPoints& points,
                    std::span<float> out) {
    const hn::CappedTag<float, min_group> df;
    const std::size_t lanes = hn::Lanes(df);
    double farthest = 0;
    for (const double scale : points.scales) farthest = std::max(farthest, std::abs(scale));
    thread_local GroupWeights weights;
    HWY_ALIGN float along[max_group];  // t
    for (std::size_t begin = 0, count = 0; begin < out.size(); begin += count) {
        double low = 0, high = 0;
        for (count = std::min(max_group, out.size() - begin);; count /= 2) {
            const auto some = points.slopes.subspan(begin, count);
            low = *std::min_element(some.begin(), some.end());
            high = *std::max_element(some.begin(), some.end());
            if (farthest * (high - low) <= max_spread || count <= min_group) break;
        }
        const std::span<float> own = out.subspan(begin, count);
        const ColumnPoints group{points.slopes.subspan(begin, count), points.scales, points.offset};
        if (farthest * (high - low) > max_spread || height < TwelvePoint::taps) {
            sum_down_columns_plain(values + begin, stride, height, group, own);
            continue;
        }
        weights.set(points, {low, 0.5 * (low + high), high}, height);
        std::fill(own.begin(), own.end(), 0.0f);
        if (!weights.scales_apart.empty())
            sum_down_columns_plain(values + begin, stride, height, {group.slopes, weights.scales_apart, points.offset},
                                   own);
        const double share = high > low ? 1 / (high - low) : 0;
        for (std::size_t i = 0; i < count; ++i) along[i] = static_cast<float>((group.slopes[i] - low) * share);
        const std::size_t taps = weights.nodes[0].size();
        const float* from = values + weights.first * stride + begin;
        const float *a = weights.nodes[0].data(), *b = weights.nodes[1].data(), *c = weights.nodes[2].data();
        std::size_t i = 0;
        for (; i + lanes <= count; i += lanes) {
            const auto t = hn::LoadU(df, along + i);
            auto sum = hn::LoadU(df, &own[i]);
            for (std::size_t k = 0; k < taps; ++k) {
                const auto weight =
                    hn::MulAdd(hn::MulAdd(hn::Set(df, c[k]), t, hn::Set(df, b[k])), t, hn::Set(df, a[k]));
                sum = hn::MulAdd(weight, hn::LoadU(df, from + k * stride + i), sum);
            }
            hn::StoreU(sum, df, &own[i]);
        }
        for (; i < count; ++i)
            for (std::size_t k = 0; k < taps; ++k)
                own[i] += ((c[k] * along[i] + b[k]) * along[i] + a[k]) * from[k * stride + i];
    }
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

HWY_EXPORT(SumDownColumns);
HWY_EXPORT(AddAlongLine);

void sum_down_columns(const float* values, std::size_t stride, std::size_t height, const ColumnPoints& points,
                      std::span<float> out) {
    HWY_DYNAMIC_DISPATCH(SumDownColumns)(values, stride, height, points, out);
}

void add_along_line(std::span<const float> line, const LinePlaces& places, float weight, std::span<float> out) {
    HWY_DYNAMIC_DISPATCH(AddAlongLine)(line, places, weight, out);
}

}  // namespace hogel::optics::film
#endif
