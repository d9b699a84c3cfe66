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
    double spread = 0, min_floor = end, max_floor = 0;
    inside_points_.clear();
    for (const Point& point : points) {
        const double low = std::floor(std::min(point.low, point.high)),
                     high = std::floor(std::max(point.low, point.high));
        if (!(low >= before && high + after < end)) continue;
        inside_points_.push_back(point);
        spread = std::max(spread, std::abs(point.high - point.low));
        min_floor = std::min(min_floor, low);
        max_floor = std::max(max_floor, high);
    }
    if (spread > max_line_spread) return false;
    nodes_ = line_nodes(spread);
    first_ = inside_points_.empty() ? 0 : static_cast<std::size_t>(min_floor - before);
    taps_ = inside_points_.empty() ? 0 : static_cast<std::size_t>(max_floor + after) + 1 - first_;
    weights_.assign(nodes_ * stride(), 0.0f);
    for (std::size_t node = 0; node < nodes_; ++node)
        add_weights(inside_points_, node, nodes_, first_, weights_.data() + node * stride());
    return true;
}

void add_weights_plain(std::span<const MergedWeights::Point> points, std::size_t node, std::size_t nodes,
                       std::size_t first, float* to) {
    for (const MergedWeights::Point& point : points) {
        const double position = at_node(node, nodes, point.low, point.high), floor_position = std::floor(position);
        const auto factor = static_cast<float>(at_node(node, nodes, point.low_factor, point.high_factor));
        const auto weights = TwelvePoint::table().weights(static_cast<float>(position - floor_position) - 0.5f);
        float* destination = to + (static_cast<std::size_t>(floor_position) - TwelvePoint::before - first);
        for (std::size_t k = 0; k < TwelvePoint::taps; ++k) destination[k] += factor * weights[k];
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
