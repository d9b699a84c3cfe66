// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hogel::camera::film {

/// Parallel lines have interpolation weights that change little from line to line. They are computed at a few nodes
/// between the first and the last line. Between nodes, the weight of a tap is a polynomial of the line's parameter t,
/// from −1 at the first to 1 at the last line. The number of nodes depends on the spread: the range of a value's
/// positions over the lines, in samples. Weights are then within 5·10⁻⁴ of the exact ones.
inline constexpr std::size_t max_line_nodes = 5;
inline constexpr double max_line_spread = 0.5;

constexpr std::size_t line_nodes(double spread) { return spread <= 0.03 ? 2 : spread <= 0.15 ? 3 : max_line_nodes; }

/// Return t at a node, and the linear interpolation at a node between a value on the first and one on the last line.
constexpr double node_position(std::size_t node, std::size_t nodes) {
    return 2 * static_cast<double>(node) / static_cast<double>(nodes - 1) - 1;
}
inline double at_node(std::size_t node, std::size_t nodes, double low, double high) {
    return std::lerp(low, high, static_cast<double>(node) / static_cast<double>(nodes - 1));
}
inline float line_position(double value, double low, double high) {
    return high > low ? static_cast<float>((2 * value - low - high) / (high - low)) : 0.0f;
}

/// Computes the shares of the nodes in the weights of line t, by Lagrange interpolation.
inline void line_shares_plain(float t, std::size_t nodes, float* shares) {
    for (std::size_t node = 0; node < nodes; ++node) {
        double share = 1;
        for (std::size_t other = 0; other < nodes; ++other)
            if (other != node)
                share *= (t - node_position(other, nodes)) / (node_position(node, nodes) - node_position(other, nodes));
        shares[node] = static_cast<float>(share);
    }
}

}  // namespace hogel::camera::film
