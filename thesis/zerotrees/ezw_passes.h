// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "thesis/zerotrees/forest.h"

namespace hogel::zerotrees {

enum class EzwSymbol { positive, negative, zerotree, isolated };

struct EzwContext {
    bool leaf;            // a leaf, which cannot be an isolated zero
    bool not_a_zerotree;  // its subtree has a found coefficient, so it cannot be a zerotree
    bool parent_found;
    bool previous_found;  // whether the previous coefficient of this pass was found
};

// Runs the passes of EZW over integer magnitudes of `planes` bits, shared by encoder and decoder. Threshold T is
// 2^plane: a magnitude m in (T, 2T] on the scale of the values is an integer with floor(log2) = plane.
// coder.symbol(context, index, plane) writes or reads a symbol and returns it; coder.refine(index, plane) writes or
// reads the bit of that plane; coder.full() stops the passes.
template <class Coder>
void ezw_passes(const Forest& forest, int planes, Coder& coder) {
    std::vector<bool> is_found(forest.size()),
        is_open(forest.size());  // open: no zerotree in this pass or an earlier one
    std::vector<std::size_t> found;
    for (int plane = planes - 1; plane >= 0; --plane) {
        bool previous_found = false;
        for (const Forest::Band& band : forest.bands()) {
            if (coder.full()) return;
            forest.for_each(band, [&](std::size_t index, std::size_t parent) {
                const bool root = parent == Forest::no_parent;
                if (is_found[index] || (!root && !is_open[parent]) || coder.full()) return;
                const EzwContext context{band.leaf, is_open[index], !root && is_found[parent], previous_found};
                const EzwSymbol symbol = coder.symbol(context, index, plane);
                if (coder.full()) return;
                previous_found = symbol == EzwSymbol::positive || symbol == EzwSymbol::negative;
                if (previous_found) {
                    is_found[index] = true;
                    found.push_back(index);
                }
                if (symbol != EzwSymbol::zerotree) is_open[index] = true;
            });
        }
        if (plane == 0) return;
        for (std::size_t index : found) {
            if (coder.full()) return;
            coder.refine(index, plane - 1);
        }
    }
}

// Derives the symbols from integer magnitudes and signs.
class EzwMagnitudes {
  public:
    EzwMagnitudes(const Forest& forest, std::vector<std::uint32_t> magnitudes, std::vector<bool> negative)
        : magnitudes_(std::move(magnitudes)), negative_(std::move(negative)), subtree_bits_(forest.size()) {
        for (auto band = forest.bands().rbegin(); band != forest.bands().rend(); ++band)
            forest.for_each(*band, [&](std::size_t index, std::size_t parent) {
                const auto bits = static_cast<std::uint8_t>(std::bit_width(magnitudes_[index]));
                subtree_bits_[index] = std::max(subtree_bits_[index], bits);
                if (parent != Forest::no_parent)
                    subtree_bits_[parent] = std::max(subtree_bits_[parent], subtree_bits_[index]);
            });
    }
    EzwSymbol symbol(std::size_t index, int plane) const {
        if (magnitudes_[index] >> plane != 0) return negative_[index] ? EzwSymbol::negative : EzwSymbol::positive;
        return subtree_bits_[index] > plane ? EzwSymbol::isolated : EzwSymbol::zerotree;
    }
    bool bit(std::size_t index, int plane) const { return magnitudes_[index] >> plane & 1; }

  private:
    std::vector<std::uint32_t> magnitudes_;
    std::vector<bool> negative_;
    std::vector<std::uint8_t> subtree_bits_;
};

}  // namespace hogel::zerotrees
