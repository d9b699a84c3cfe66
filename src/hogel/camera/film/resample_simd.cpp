// SPDX-License-Identifier: Apache-2.0
// Vector step of resample.cpp, compiled for every SIMD target and chosen when first called.
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

constexpr std::size_t complex_row = 2 * optics::block_lines;
constexpr std::size_t taps = InterpolationTable::taps;
constexpr std::size_t values_per_pass = 64;  // values per pass
constexpr double max_position = 1e9;         // a position beyond any line

// First samples and table phases of a node, for a batch of values.
struct Node {
    HWY_ALIGN std::int32_t first[values_per_pass], phase[values_per_pass];

    void set(const TangentPositions& positions, double square, double scale, std::size_t begin, std::size_t count) {
        const hn::ScalableTag<double> d;
        const hn::Rebind<std::int32_t, decltype(d)> di;
        const auto steps = hn::Iota(d, 0);
        for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
            const auto s = hn::MulAdd(hn::Add(steps, hn::Set(d, static_cast<double>(begin + i))),
                                      hn::Set(d, positions.step), hn::Set(d, positions.first));
            const auto root = hn::Sqrt(hn::Max(hn::NegMulAdd(s, s, hn::Set(d, square)), hn::Set(d, 1e-12)));
            const auto exact = hn::MulAdd(hn::Div(s, root), hn::Set(d, scale), hn::Set(d, positions.offset));
            const auto clamped = hn::Clamp(exact, hn::Set(d, -max_position), hn::Set(d, max_position));
            const auto floor_position = hn::Floor(clamped), fraction = hn::Sub(clamped, floor_position);
            hn::Store(hn::DemoteTo(di, hn::Sub(floor_position, hn::Set(d, InterpolationTable::before))), di, first + i);
            hn::Store(hn::DemoteTo(di, hn::MulAdd(fraction, hn::Set(d, InterpolationTable::phases), hn::Set(d, 0.5))),
                      di, phase + i);
        }
    }
};

// Computes the sums over `count` samples of the lines, with the weights of each node.
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
            re = hn::MulAdd(weight, hn::Load(d, samples + k * complex_row + i), re);
            im = hn::MulAdd(weight, hn::Load(d, samples + k * complex_row + optics::block_lines + i), im);
        }
        if (!all) {
            const auto mask = hn::Ne(hn::Load(d, lines.mask + i), hn::Zero(d));
            re = hn::IfThenElse(mask, re, hn::Load(d, out + i));
            im = hn::IfThenElse(mask, im, hn::Load(d, out + optics::block_lines + i));
        }
        hn::Store(re, d, out + i);
        hn::Store(im, d, out + optics::block_lines + i);
    }
}

template <std::size_t nodes>
HWY_INLINE void resample(const float* lines, std::size_t size, const TangentPositions& positions,
                         const TangentNodes& line_nodes, const InterpolationTable& table, std::size_t count,
                         float* out) {
    Node node_samples[nodes];
    const bool all =
        std::all_of(line_nodes.mask, line_nodes.mask + optics::block_lines, [](float one) { return one != 0; });
    for (std::size_t begin = 0; begin < count; begin += values_per_pass) {
        const std::size_t batch = std::min(values_per_pass, count - begin);
        for (std::size_t node = 0; node < nodes; ++node)
            node_samples[node].set(positions, line_nodes.squares[node], line_nodes.scales[node], begin, batch);
        for (std::size_t i = 0; i < batch; ++i, out += complex_row) {
            const float* weights[nodes];
            std::int32_t first = node_samples[0].first[i], last = first;
            for (std::size_t node = 0; node < nodes; ++node) {
                weights[node] = table.weights_of_phase(static_cast<std::size_t>(node_samples[node].phase[i]));
                first = std::min(first, node_samples[node].first[i]);
                last = std::max(last, node_samples[node].first[i]);
            }
            const auto end = static_cast<std::int32_t>(size);
            if (first == last && first >= 0 && first + static_cast<std::int32_t>(taps) <= end) {
                sum_taps<nodes>(lines + static_cast<std::size_t>(first) * complex_row, weights, taps, line_nodes, all,
                                out);
                continue;
            }
            // Nodes on both sides of a sample, or at an end: shifts the weights of all nodes to a common first sample.
            float shifted[nodes][taps + 1] = {};
            const float* shifted_weights[nodes];
            const std::int32_t begin_sample = std::clamp(first, 0, end),
                               end_sample =
                                   std::clamp(last + static_cast<std::int32_t>(taps), begin_sample,
                                              std::min(end, begin_sample + static_cast<std::int32_t>(taps) + 1));
            for (std::size_t node = 0; node < nodes; ++node) {
                for (std::int32_t k = begin_sample; k < end_sample; ++k)
                    if (const std::int32_t tap = k - node_samples[node].first[i];
                        tap >= 0 && tap < static_cast<std::int32_t>(taps))
                        shifted[node][k - begin_sample] = weights[node][tap];
                shifted_weights[node] = shifted[node];
            }
            sum_taps<nodes>(lines + static_cast<std::size_t>(begin_sample) * complex_row, shifted_weights,
                            static_cast<std::size_t>(end_sample - begin_sample), line_nodes, all, out);
        }
    }
}

void ResampleNodes(const float* lines, std::size_t size, const TangentPositions& positions, const TangentNodes& nodes,
                   const InterpolationTable& table, std::size_t count, float* out) {
    with_nodes(nodes.nodes, [&](auto fixed_count) HWY_ATTR {
        resample<fixed_count()>(lines, size, positions, nodes, table, count, out);
    });
}

}  // namespace hogel::camera::film::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::film {
HOGEL_DISPATCH(resample_nodes, ResampleNodes);
}  // namespace hogel::camera::film
