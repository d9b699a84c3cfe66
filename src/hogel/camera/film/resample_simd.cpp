// SPDX-License-Identifier: Apache-2.0
// The vector step of resample.cpp, compiled for every SIMD target and chosen when first called.
#include <algorithm>
#include <cstdint>

#include "hogel/camera/film/resample.h"
#include "hogel/core/simd_targets-inl.h"

// After simd_targets-inl.h:
#include "hogel/camera/film/line_shares-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::film::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, optics::block_lines>;
using V = hn::Vec<D>;

constexpr std::size_t both = 2 * optics::block_lines;
constexpr std::size_t taps = InterpolationTable::taps;
constexpr std::size_t together = 64;  // values whose places are computed at once
constexpr double far_away = 1e9;      // a place beyond any line

// The first samples and the table's phases of a node, of some values.
struct Node {
    HWY_ALIGN std::int32_t first[together], phase[together];

    void set(const TangentPositions& places, double square, double scale, std::size_t begin, std::size_t count) {
        const hn::ScalableTag<double> d;
        const hn::Rebind<std::int32_t, decltype(d)> di;
        const auto steps = hn::Iota(d, 0);
        for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
            const auto s = hn::MulAdd(hn::Add(steps, hn::Set(d, static_cast<double>(begin + i))),
                                      hn::Set(d, places.step), hn::Set(d, places.first));
            const auto root = hn::Sqrt(hn::Max(hn::NegMulAdd(s, s, hn::Set(d, square)), hn::Set(d, 1e-12)));
            const auto exact = hn::MulAdd(hn::Div(s, root), hn::Set(d, scale), hn::Set(d, places.offset));
            const auto place = hn::Clamp(exact, hn::Set(d, -far_away), hn::Set(d, far_away));
            const auto whole = hn::Floor(place), fraction = hn::Sub(place, whole);
            hn::Store(hn::DemoteTo(di, hn::Sub(whole, hn::Set(d, InterpolationTable::before))), di, first + i);
            hn::Store(hn::DemoteTo(di, hn::MulAdd(fraction, hn::Set(d, InterpolationTable::phases), hn::Set(d, 0.5))),
                      di, phase + i);
        }
    }
};

// The sums over `count` samples of the lines, with the weights of each node.
template <std::size_t nodes>
HWY_INLINE void sum_taps(const float* samples, const float* const (&weights)[nodes], std::size_t count,
                         const TangentNodes& lines, bool all, float* out) {
    const D d;
    for (std::size_t i = 0; i < optics::block_lines; i += hn::Lanes(d)) {
        V shares[nodes];
        line_shares(d, hn::Load(d, lines.t + i), shares);
        V re = hn::Zero(d), im = hn::Zero(d);
        for (std::size_t k = 0; k < count; ++k) {
            V weight = hn::Mul(shares[0], hn::Set(d, weights[0][k]));
            for (std::size_t node = 1; node < nodes; ++node)
                weight = hn::MulAdd(shares[node], hn::Set(d, weights[node][k]), weight);
            re = hn::MulAdd(weight, hn::Load(d, samples + k * both + i), re);
            im = hn::MulAdd(weight, hn::Load(d, samples + k * both + optics::block_lines + i), im);
        }
        if (!all) {
            const auto chosen = hn::Ne(hn::Load(d, lines.chosen + i), hn::Zero(d));
            re = hn::IfThenElse(chosen, re, hn::Load(d, out + i));
            im = hn::IfThenElse(chosen, im, hn::Load(d, out + optics::block_lines + i));
        }
        hn::Store(re, d, out + i);
        hn::Store(im, d, out + optics::block_lines + i);
    }
}

template <std::size_t nodes>
HWY_INLINE void resample(const float* lines, std::size_t size, const TangentPositions& places,
                         const TangentNodes& between, const InterpolationTable& table, std::size_t count, float* out) {
    Node own[nodes];
    const bool all =
        std::all_of(between.chosen, between.chosen + optics::block_lines, [](float one) { return one != 0; });
    for (std::size_t begin = 0; begin < count; begin += together) {
        const std::size_t some = std::min(together, count - begin);
        for (std::size_t node = 0; node < nodes; ++node)
            own[node].set(places, between.squares[node], between.scales[node], begin, some);
        for (std::size_t i = 0; i < some; ++i, out += both) {
            const float* weights[nodes];
            std::int32_t first = own[0].first[i], last = first;
            for (std::size_t node = 0; node < nodes; ++node) {
                weights[node] = table.weights_of_phase(static_cast<std::size_t>(own[node].phase[i]));
                first = std::min(first, own[node].first[i]);
                last = std::max(last, own[node].first[i]);
            }
            const auto end = static_cast<std::int32_t>(size);
            if (first == last && first >= 0 && first + static_cast<std::int32_t>(taps) <= end) {
                sum_taps<nodes>(lines + static_cast<std::size_t>(first) * both, weights, taps, between, all, out);
                continue;
            }
            // Nodes on both sides of a sample, or at an end of the lines: weights from one sample on for all nodes.
            float shifted[nodes][taps + 1] = {};
            const float* from[nodes];
            const std::int32_t begin_of_all = std::clamp(first, 0, end),
                               end_of_all =
                                   std::clamp(last + static_cast<std::int32_t>(taps), begin_of_all,
                                              std::min(end, begin_of_all + static_cast<std::int32_t>(taps) + 1));
            for (std::size_t node = 0; node < nodes; ++node) {
                for (std::int32_t k = begin_of_all; k < end_of_all; ++k)
                    if (const std::int32_t tap = k - own[node].first[i];
                        tap >= 0 && tap < static_cast<std::int32_t>(taps))
                        shifted[node][k - begin_of_all] = weights[node][tap];
                from[node] = shifted[node];
            }
            sum_taps<nodes>(lines + static_cast<std::size_t>(begin_of_all) * both, from,
                            static_cast<std::size_t>(end_of_all - begin_of_all), between, all, out);
        }
    }
}

void ResampleNodes(const float* lines, std::size_t size, const TangentPositions& places, const TangentNodes& nodes,
                   const InterpolationTable& table, std::size_t count, float* out) {
    with_nodes(nodes.nodes,
               [&](auto number) HWY_ATTR { resample<number()>(lines, size, places, nodes, table, count, out); });
}

}  // namespace hogel::camera::film::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::film {
HOGEL_DISPATCH(resample_nodes, ResampleNodes);
}  // namespace hogel::camera::film
