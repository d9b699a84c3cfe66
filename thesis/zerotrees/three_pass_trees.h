// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "thesis/zerotrees/forest.h"
#include "thesis/zerotrees/quantise.h"

namespace hogel::zerotrees {

// Passes of the three-pass coder over the trees, shared by encoder and decoder. They use numbers of bits instead of
// [K]'s p: a level of n bits has p_n = b_max − n, and a subtree with a largest level of t bits has p_t = b_max − t.

// Second pass, from leaves to roots: returns the bits of the largest level in each subtree.
inline std::vector<std::uint8_t> subtree_bits(const Forest& forest, std::span<const float> values,
                                              const Quantiser& quantiser) {
    std::vector<std::uint8_t> bits(forest.size());
    for (auto band = forest.bands().rbegin(); band != forest.bands().rend(); ++band)
        forest.for_each(*band, [&](std::size_t index, std::size_t parent) {
            const auto level_bits = static_cast<std::uint8_t>(std::bit_width(quantiser.level(values[index])));
            bits[index] = std::max(bits[index], level_bits);
            if (parent != Forest::no_parent) bits[parent] = std::max(bits[parent], bits[index]);
        });
    return bits;
}

// Third pass, from roots to leaves. Calls for each coefficient with symbols
//   sink.tree(Δp_t or −1, bits of the parent's subtree, leaf),
//   sink.node(Δp_n or −1, bits of its subtree) unless it is a leaf, and
//   sink.magnitude(level, its bits, negative).
template <class Sink>
void write_three_pass(const Forest& forest, std::span<const float> values, const Quantiser& quantiser, int planes,
                      Sink& sink) {
    const std::vector<std::uint8_t> bits = subtree_bits(forest, values, quantiser);
    for (const Forest::Band& band : forest.bands())
        forest.for_each(band, [&](std::size_t index, std::size_t parent) {
            const int above = parent == Forest::no_parent ? planes : bits[parent];
            if (above == 0) return;
            const int tree = bits[index];
            sink.tree(tree == 0 ? -1 : above - tree, above, band.leaf);
            if (tree == 0) return;
            const std::uint32_t level = quantiser.level(values[index]);
            const int level_bits = std::bit_width(level);
            if (!band.leaf) sink.node(level_bits == 0 ? -1 : tree - level_bits, tree);
            if (level_bits > 0) sink.magnitude(level, level_bits, values[index] < 0);
        });
}

// Inverts the third pass. source.tree(bits of the parent's subtree, leaf) returns Δp_t below them or −1,
// source.node(bits of the subtree) Δp_n or −1, source.magnitude(bits of the level) level and sign.
template <class Source>
void read_three_pass(const Forest& forest, const Quantiser& quantiser, int planes, Source& source,
                     std::span<float> values) {
    std::vector<std::uint8_t> bits(forest.size());
    std::fill(values.begin(), values.end(), 0.0f);
    for (const Forest::Band& band : forest.bands())
        forest.for_each(band, [&](std::size_t index, std::size_t parent) {
            const int above = parent == Forest::no_parent ? planes : bits[parent];
            if (above == 0) return;
            const int tree_symbol = source.tree(above, band.leaf);
            if (tree_symbol < 0) return;
            const int tree = above - tree_symbol;
            bits[index] = static_cast<std::uint8_t>(tree);
            const int node_symbol = band.leaf ? 0 : source.node(tree);
            if (node_symbol < 0) return;
            const auto [level, negative] = source.magnitude(tree - node_symbol);
            values[index] = quantiser.value(level, negative);
        });
}

}  // namespace hogel::zerotrees
