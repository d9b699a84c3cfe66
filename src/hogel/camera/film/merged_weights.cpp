// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/merged_weights.h"

#include <algorithm>
#include <cmath>

#include "hogel/camera/film/interpolation.h"
#include "hogel/optics/lines.h"

namespace hogel::camera::film {

bool MergedWeights::set(std::span<const Point> points, std::size_t size) {
    constexpr double before = TwelvePoint::before, after = TwelvePoint::after;
    const auto end = static_cast<double>(size);
    double spread = 0, lowest = end, highest = 0;
    inside_.clear();
    for (const Point& point : points) {
        const double low = std::floor(std::min(point.low, point.high)),
                     high = std::floor(std::max(point.low, point.high));
        if (!(low >= before && high + after < end)) continue;
        inside_.push_back(point);
        spread = std::max(spread, std::abs(point.high - point.low));
        lowest = std::min(lowest, low);
        highest = std::max(highest, high);
    }
    if (spread > max_line_spread) return false;
    nodes_ = line_nodes(spread);
    first_ = inside_.empty() ? 0 : static_cast<std::size_t>(lowest - before);
    taps_ = inside_.empty() ? 0 : static_cast<std::size_t>(highest + after) + 1 - first_;
    weights_.assign(nodes_ * stride(), 0.0f);
    for (std::size_t node = 0; node < nodes_; ++node)
        add_weights(inside_, node, nodes_, first_, weights_.data() + node * stride());
    return true;
}

void add_weights_plain(std::span<const MergedWeights::Point> points, std::size_t node, std::size_t nodes,
                       std::size_t first, float* to) {
    for (const MergedWeights::Point& point : points) {
        const double place = at_node(node, nodes, point.low, point.high), whole = std::floor(place);
        const auto factor = static_cast<float>(at_node(node, nodes, point.low_factor, point.high_factor));
        const auto weights = TwelvePoint::table().weights(static_cast<float>(place - whole) - 0.5f);
        float* own = to + (static_cast<std::size_t>(whole) - TwelvePoint::before - first);
        for (std::size_t k = 0; k < TwelvePoint::taps; ++k) own[k] += factor * weights[k];
    }
}

void sum_merged_plain(const float* values, const MergedWeights& weights, const float* t, float* out) {
    for (std::size_t line = 0; line < optics::block_lines; ++line) {
        float shares[max_line_nodes];
        line_shares_plain(t[line], weights.nodes(), shares);
        out[line] = 0;
        for (std::size_t tap = 0; tap < weights.taps(); ++tap) {
            float weight = 0;
            for (std::size_t node = 0; node < weights.nodes(); ++node)
                weight += shares[node] * weights.weights(node)[tap];
            out[line] += weight * values[(weights.first() + tap) * optics::block_lines + line];
        }
    }
}

}  // namespace hogel::camera::film
