// SPDX-License-Identifier: Apache-2.0
// Vector twins of merged_weights.cpp, compiled for every SIMD target and chosen when first called.
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

// Coefficients of TwelvePoint, padded with zeros for each power.
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
        const double position = point.low + share * (point.high - point.low);
        const auto floor_position = static_cast<std::size_t>(position);  // not negative
        const auto z = hn::Set(d, static_cast<float>(position - static_cast<double>(floor_position)) - 0.5f);
        const auto factor =
            hn::Set(d, point.low_factor + static_cast<float>(share) * (point.high_factor - point.low_factor));
        float* destination = to + (floor_position - TwelvePoint::before - first);
        for (std::size_t k = 0; k < optics::block_lines; k += hn::Lanes(d)) {
            auto weight = hn::Load(d, coefficients.values[TwelvePoint::terms - 1] + k);
            for (std::size_t p = TwelvePoint::terms - 1; p-- > 0;)
                weight = hn::MulAdd(weight, z, hn::Load(d, coefficients.values[p] + k));
            hn::StoreU(hn::MulAdd(weight, factor, hn::LoadU(d, destination + k)), d, destination + k);
        }
    }
}

template <std::size_t nodes>
HWY_INLINE void sum_taps(const float* values, const MergedWeights& weights, const float* t, float* out) {
    const D d;
    const std::size_t taps = weights.taps();
    const float* node_weights[nodes];
    for (std::size_t node = 0; node < nodes; ++node) node_weights[node] = weights.weights(node);
    for (std::size_t i = 0; i < optics::block_lines; i += hn::Lanes(d)) {
        hn::Vec<D> shares[nodes];
        line_shares(d, hn::LoadU(d, t + i), shares);
        auto sum = hn::Zero(d);
        for (std::size_t tap = 0; tap < taps; ++tap) {
            auto weight = hn::Mul(shares[0], hn::Set(d, node_weights[0][tap]));
            for (std::size_t node = 1; node < nodes; ++node)
                weight = hn::MulAdd(shares[node], hn::Set(d, node_weights[node][tap]), weight);
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
