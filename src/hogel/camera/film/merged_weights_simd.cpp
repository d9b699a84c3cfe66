// SPDX-License-Identifier: Apache-2.0
// The vector twins of merged_weights.cpp, compiled for every SIMD target and chosen when first called.
#include <algorithm>
#include <array>

#include "hogel/camera/film/interpolation.h"
#include "hogel/camera/film/merged_weights.h"
#include "hogel/core/simd_targets-inl.h"
#include "hogel/optics/lines.h"

// After simd_targets-inl.h:
#include "hogel/camera/film/line_shares-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::film::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, optics::block_lines>;

// The coefficients of TwelvePoint, each power's filled up with zeros.
struct Coefficients {
    HWY_ALIGN float values[TwelvePoint::terms][optics::block_lines] = {};

    Coefficients() {
        for (std::size_t p = 0; p < TwelvePoint::terms; ++p)
            std::ranges::copy(TwelvePoint::table().coefficients()[p], values[p]);
    }
};

void AddWeights(std::span<const MergedWeights::Point> points, std::size_t node, std::size_t nodes, std::size_t first,
                float* to) {
    static const Coefficients coefficients;
    const D d;
    const double share = static_cast<double>(node) / static_cast<double>(nodes - 1);
    for (const MergedWeights::Point& point : points) {
        const double place = point.low + share * (point.high - point.low);
        const auto whole = static_cast<std::size_t>(place);  // not below zero
        const auto z = hn::Set(d, static_cast<float>(place - static_cast<double>(whole)) - 0.5f);
        const auto factor =
            hn::Set(d, point.low_factor + static_cast<float>(share) * (point.high_factor - point.low_factor));
        float* own = to + (whole - TwelvePoint::before - first);
        for (std::size_t k = 0; k < optics::block_lines; k += hn::Lanes(d)) {
            auto weight = hn::Load(d, coefficients.values[TwelvePoint::terms - 1] + k);
            for (std::size_t p = TwelvePoint::terms - 1; p-- > 0;)
                weight = hn::MulAdd(weight, z, hn::Load(d, coefficients.values[p] + k));
            hn::StoreU(hn::MulAdd(weight, factor, hn::LoadU(d, own + k)), d, own + k);
        }
    }
}

template <std::size_t nodes>
HWY_INLINE void sum_taps(const float* values, const MergedWeights& weights, const float* t, float* out) {
    const D d;
    const std::size_t taps = weights.taps();
    const float* own[nodes];
    for (std::size_t node = 0; node < nodes; ++node) own[node] = weights.weights(node);
    for (std::size_t i = 0; i < optics::block_lines; i += hn::Lanes(d)) {
        hn::Vec<D> shares[nodes];
        line_shares(d, hn::LoadU(d, t + i), shares);
        auto sum = hn::Zero(d);
        for (std::size_t tap = 0; tap < taps; ++tap) {
            auto weight = hn::Mul(shares[0], hn::Set(d, own[0][tap]));
            for (std::size_t node = 1; node < nodes; ++node)
                weight = hn::MulAdd(shares[node], hn::Set(d, own[node][tap]), weight);
            sum = hn::MulAdd(weight, hn::LoadU(d, values + tap * optics::block_lines + i), sum);
        }
        hn::StoreU(sum, d, out + i);
    }
}

void SumMerged(const float* values, const MergedWeights& weights, const float* t, float* out) {
    const float* first = values + weights.first() * optics::block_lines;
    with_nodes(weights.nodes(), [&](auto nodes) HWY_ATTR { sum_taps<nodes()>(first, weights, t, out); });
}

}  // namespace hogel::camera::film::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::film {
HOGEL_DISPATCH(add_weights, AddWeights);
HOGEL_DISPATCH(sum_merged, SumMerged);
}  // namespace hogel::camera::film
