// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hogel::camera::film {

/// Lines whose interpolation weights are taken from those of a few nodes between the first and the last of them. The
/// weight of a tap is a polynomial of t = −1 … 1, which says which line it is, through its values at the nodes.
/// How many nodes are needed depends on how much the places of a value differ between the lines, in samples: weights
/// are then within 5·10⁻⁴ of the exact ones.
inline constexpr std::size_t max_line_nodes = 5;
inline constexpr double max_line_spread = 0.5;

constexpr std::size_t line_nodes(double spread) { return spread <= 0.03 ? 2 : spread <= 0.15 ? 3 : max_line_nodes; }

/// t at a node, and a value at a node between those of the first and the last line.
constexpr double node_place(std::size_t node, std::size_t nodes) {
    return 2 * static_cast<double>(node) / static_cast<double>(nodes - 1) - 1;
}
inline double at_node(std::size_t node, std::size_t nodes, double low, double high) {
    return std::lerp(low, high, static_cast<double>(node) / static_cast<double>(nodes - 1));
}
/// t of a line with a value between those of the first and the last one.
inline float line_place(double value, double low, double high) {
    return high > low ? static_cast<float>((2 * value - low - high) / (high - low)) : 0.0f;
}

/// The shares of the nodes in the weights of line t, by Lagrange.
inline void line_shares_plain(float t, std::size_t nodes, float* shares) {
    for (std::size_t node = 0; node < nodes; ++node) {
        double share = 1;
        for (std::size_t other = 0; other < nodes; ++other)
            if (other != node)
                share *= (t - node_place(other, nodes)) / (node_place(node, nodes) - node_place(other, nodes));
        shares[node] = static_cast<float>(share);
    }
}

}  // namespace hogel::camera::film
