// SPDX-License-Identifier: Apache-2.0
// The vector twins of resample.cpp, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/optics/film/resample_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "hogel/optics/film/resample.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::optics::film {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// A vector of one lane cannot hold a complex number.
void ResampleTangents(std::span<const std::complex<float>> line, const TangentPlaces& places,
                      const InterpolationTable& table, std::span<std::complex<float>> out) {
    resample_tangents_plain(line, places, table, out);
}
#else
using Doubles = hn::ScalableTag<double>;
// Weights and samples of a place, no more lanes than half of them.
using Floats = hn::CappedTag<float, 8>;

// The sums over all taps k = j modulo half the lanes, for each j.
HWY_INLINE hn::Vec<Floats> sums_of_pairs(const float* z, const float* weights) {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    auto sum = hn::Mul(hn::LoadU(d, z), hn::LoadU(d, weights));
    for (std::size_t k = lanes; k < 2 * InterpolationTable::taps; k += lanes)
        sum = hn::MulAdd(hn::LoadU(d, z + k), hn::LoadU(d, weights + k), sum);
    return sum;
}

// out[i] = the sum of the complex numbers i · lanes/2 … of `sums`, whose count is a multiple of four.
HWY_INLINE void add_up(const float* sums, std::size_t count, float* out) {
    const Floats d;
    const hn::Repartition<double, Floats> pairs;
    const std::size_t lanes = hn::Lanes(d);
    if (lanes == 8) {
        // Four complex numbers of each of four places, which become the lanes.
        for (std::size_t i = 0; i < count; i += 4) {
            hn::Vec<decltype(pairs)> a, b, c, e;
            hn::LoadInterleaved4(pairs, reinterpret_cast<const double*>(sums + 8 * i), a, b, c, e);
            hn::StoreU(
                hn::Add(hn::Add(hn::BitCast(d, a), hn::BitCast(d, c)), hn::Add(hn::BitCast(d, b), hn::BitCast(d, e))),
                d, out + 2 * i);
        }
        return;
    }
    for (std::size_t i = 0; i < 2 * count; ++i) {
        const float* own = sums + i / 2 * lanes + i % 2;
        out[i] = lanes == 2 ? own[0] : own[0] + own[2];
    }
}

void ResampleTangents(std::span<const std::complex<float>> line, const TangentPlaces& places,
                      const InterpolationTable& table, std::span<std::complex<float>> out) {
    const Doubles dd;
    const Floats df;
    const hn::Rebind<std::int32_t, Doubles> di;
    constexpr std::size_t together = 64;
    HWY_ALIGN double wholes[together], fractions[together];
    HWY_ALIGN std::int32_t first_taps[together], phases[together];
    HWY_ALIGN float sums[together * 8], values[2 * together];
    const std::size_t lanes = hn::Lanes(dd), floats = hn::Lanes(df);
    const auto steps = hn::Iota(dd, 0);
    // The first taps of places whose taps are all on the line; places are rounded to whole numbers of 32 bits.
    const auto last = static_cast<std::int32_t>(
        std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(line.size()) - InterpolationTable::taps, INT32_MAX - 1));
    const float* weights = table.weights(0);
    for (std::size_t begin = 0; begin < out.size(); begin += together) {
        const std::size_t count = std::min(together, out.size() - begin);
        for (std::size_t i = 0; i < count; i += lanes) {
            const auto s = hn::MulAdd(hn::Add(steps, hn::Set(dd, static_cast<double>(begin + i))),
                                      hn::Set(dd, places.step), hn::Set(dd, places.first));
            const auto root = hn::Sqrt(hn::NegMulAdd(s, s, hn::Set(dd, places.square)));
            const auto place = hn::MulAdd(hn::Div(s, root), hn::Set(dd, places.scale), hn::Set(dd, places.offset));
            const auto whole = hn::Floor(place);
            const auto first_tap = hn::Sub(whole, hn::Set(dd, InterpolationTable::before));
            const auto fraction = hn::Sub(place, whole);
            hn::Store(whole, dd, wholes + i);
            hn::Store(fraction, dd, fractions + i);
            hn::Store(hn::DemoteTo(di, first_tap), di, first_taps + i);
            hn::Store(hn::DemoteTo(di, hn::MulAdd(fraction, hn::Set(dd, InterpolationTable::phases), hn::Set(dd, 0.5))),
                      di, phases + i);
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (first_taps[i] >= 0 && first_taps[i] <= last) {
                hn::Store(sums_of_pairs(reinterpret_cast<const float*>(line.data() + first_taps[i]),
                                        weights + phases[i] * std::int32_t{2 * InterpolationTable::taps}),
                          df, sums + floats * i);
            } else {
                hn::Store(hn::Zero(df), df, sums + floats * i);
                const std::complex<float> value = table.at(line.data(), line.size(), wholes[i], fractions[i]);
                sums[floats * i] = value.real();
                sums[floats * i + 1] = value.imag();
            }
        }
        add_up(sums, (count + 3) / 4 * 4, values);
        std::copy_n(values, 2 * count, reinterpret_cast<float*>(out.data() + begin));
    }
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::optics::film
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::optics::film {

HWY_EXPORT(ResampleTangents);

void resample_tangents(std::span<const std::complex<float>> line, const TangentPlaces& places,
                       const InterpolationTable& table, std::span<std::complex<float>> out) {
    HWY_DYNAMIC_DISPATCH(ResampleTangents)(line, places, table, out);
}

}  // namespace hogel::optics::film
#endif
