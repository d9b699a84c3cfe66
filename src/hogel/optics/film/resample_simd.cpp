// SPDX-License-Identifier: Apache-2.0
// The vector twins of resample.cpp, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/optics/film/resample_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>

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

HWY_INLINE std::complex<float> sum_of_pairs(const float* z, const float* weights) {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    auto sum = hn::Mul(hn::LoadU(d, z), hn::LoadU(d, weights));
    for (std::size_t k = lanes; k < 2 * InterpolationTable::padded_taps; k += lanes)
        sum = hn::MulAdd(hn::LoadU(d, z + k), hn::LoadU(d, weights + k), sum);
    HWY_ALIGN float lane[8];
    hn::Store(sum, d, lane);
    if (lanes == 2) return {lane[0], lane[1]};
    if (lanes == 4) return {lane[0] + lane[2], lane[1] + lane[3]};
    return {(lane[0] + lane[4]) + (lane[2] + lane[6]), (lane[1] + lane[5]) + (lane[3] + lane[7])};
}

void ResampleTangents(std::span<const std::complex<float>> line, const TangentPlaces& places,
                      const InterpolationTable& table, std::span<std::complex<float>> out) {
    const Doubles dd;
    constexpr std::size_t together = 64;
    HWY_ALIGN double wholes[together], fractions[together];
    const std::size_t lanes = hn::Lanes(dd);
    const auto steps = hn::Iota(dd, 0);
    // The first taps of places whose padded taps are all on the line.
    const double last = static_cast<double>(line.size()) - static_cast<double>(InterpolationTable::padded_taps);
    for (std::size_t begin = 0; begin < out.size(); begin += together) {
        const std::size_t count = std::min(together, out.size() - begin);
        for (std::size_t i = 0; i < count; i += lanes) {
            const auto s = hn::MulAdd(hn::Add(steps, hn::Set(dd, static_cast<double>(begin + i))),
                                      hn::Set(dd, places.step), hn::Set(dd, places.first));
            const auto root = hn::Sqrt(hn::NegMulAdd(s, s, hn::Set(dd, places.square)));
            const auto place = hn::MulAdd(hn::Div(s, root), hn::Set(dd, places.scale), hn::Set(dd, places.offset));
            const auto whole = hn::Floor(place);
            hn::Store(hn::Sub(whole, hn::Set(dd, InterpolationTable::before)), dd, wholes + i);
            hn::Store(hn::Sub(place, whole), dd, fractions + i);
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (wholes[i] >= 0 && wholes[i] <= last) {
                const auto first = static_cast<std::ptrdiff_t>(wholes[i]);
                out[begin + i] =
                    sum_of_pairs(reinterpret_cast<const float*>(line.data() + first), table.weights(fractions[i]));
            } else {
                out[begin + i] =
                    table.at(line.data(), line.size(), wholes[i] + InterpolationTable::before, fractions[i]);
            }
        }
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
