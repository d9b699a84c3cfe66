// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

#include "hogel/codec/format/block_syntax.h"

namespace hogel::codec::format {

// Syntax of the levels of a channel of a block.

using LevelOrder = std::array<std::uint8_t, block_samples>;

// Zigzag order of JPEG: frequencies of a block by rising sum.
constexpr LevelOrder zigzag = [] {
    LevelOrder order{};
    std::size_t n = 0;
    for (std::size_t sum = 0; sum < 2 * block_side - 1; ++sum)
        for (std::size_t k = 0; k <= sum; ++k) {
            const std::size_t row = sum % 2 == 1 ? k : sum - k, column = sum - row;
            if (row < block_side && column < block_side)
                order[n++] = static_cast<std::uint8_t>(row * block_side + column);
        }
    return order;
}();

// Row-major and column-major order.
constexpr std::array<LevelOrder, 2> raster_orders = [] {
    std::array<LevelOrder, 2> order{};
    for (std::size_t n = 0; n < block_samples; ++n) {
        order[0][n] = static_cast<std::uint8_t>(n);
        order[1][n] = static_cast<std::uint8_t>(n % block_side * block_side + n / block_side);
    }
    return order;
}();

// Returns the scan order of levels, low frequencies first.
constexpr const LevelOrder& order_of_levels(Basis basis) {
    return basis.cosines() ? zigzag : raster_orders[basis.cosines_u ? 1 : 0];
}

// Lower limits of the classes of a sum of magnitudes; the classes grow wider.
constexpr std::array<std::uint8_t, level_classes - 1> level_class_begins{1, 2, 3, 5, 8, 12, 18, 28, 44, 70, 120};
constexpr int in_last_class = level_class_begins.back();
constexpr std::array<std::uint8_t, in_last_class + 1> level_class_of = [] {
    std::array<std::uint8_t, in_last_class + 1> classes{};
    for (std::size_t sum = 0; sum < classes.size(); ++sum)
        for (const std::uint8_t begin : level_class_begins)
            if (begin <= sum) ++classes[sum];
    return classes;
}();

// Codes a number of `bits` bits, highest first, as a path through a binary tree with a model at each node.
template <class Coder, class Model, std::size_t count>
std::size_t code_path(Coder& coder, std::array<Model, count>& models, int bits, std::size_t value) {
    std::size_t node = 1;
    for (int bit = bits - 1; bit >= 0; --bit) node = node * 2 + coder.bit(models[node], value >> bit & 1);
    return node - (std::size_t{1} << bits);
}

// Codes the position of the last nonzero level.
template <class Coder, class Model>
std::size_t code_last(Coder& coder, std::array<Model, block_samples>& models, const LevelOrder& order,
                      const Levels& levels) {
    std::size_t last = 0;
    if constexpr (!Coder::reads)
        for (std::size_t n = 0; n < block_samples; ++n)
            if (levels[order[n]] != 0) last = n;
    return code_path(coder, models, 6, last);
}

// Codes the index of the basis, in unary.
template <class Coder, class Model>
std::uint8_t code_basis(Coder& coder, std::array<Model, bases.size() - 1>& models, std::uint8_t basis) {
    std::uint8_t number = 0;
    while (number + 1u < bases.size() && coder.bit(models[number], basis != number)) ++number;
    return number;
}

template <class Coder>
void code_levels(Coder& coder, std::array<typename Coder::Models::ForLevels, 3>& of_bases, Basis basis,
                 Levels& levels) {
    auto& models = of_bases[basis.cosines() ? 0 : basis.samples() ? 1 : 2];
    const LevelOrder& order = order_of_levels(basis);
    const std::size_t last = code_last(coder, models.last, order, levels);
    // The last level comes first, so that the levels to the right and below are known; they are good contexts.
    std::array<std::array<std::uint8_t, block_side + 2>, block_side + 2> magnitudes{};
    std::array<std::array<std::uint8_t, block_side + 1>, block_side + 1> signs{};  // 1: positive, 2: negative
    for (std::size_t n = last + 1; n-- > 0;) {
        const std::size_t row = order[n] / block_side, column = order[n] % block_side;
        const int sum = 2 * (magnitudes[row][column + 1] + magnitudes[row + 1][column]) +
                        magnitudes[row + 1][column + 1] + magnitudes[row][column + 2] + magnitudes[row + 2][column];
        const std::size_t level_class = level_class_of[static_cast<std::size_t>(std::min(sum, in_last_class))];
        const std::size_t frequency = (basis.cosines_v ? row : 0) + (basis.cosines_u ? column : 0);
        const std::size_t frequency_class = frequency == 0 ? 0 : frequency < 3 ? 1 : 2;
        std::int32_t& level = levels[order[n]];
        std::uint32_t magnitude = static_cast<std::uint32_t>(std::abs(level));
        if (n == last || coder.bit(models.significant[level_class][frequency_class], magnitude > 0)) {
            if (!coder.bit(models.above_one[level_class][frequency_class], magnitude > 1))
                magnitude = 1;
            else if (!coder.bit(models.above_two[level_class], magnitude > 2))
                magnitude = 2;
            else
                magnitude = 3 + code_number(coder, models.rest[level_class], magnitude - 3);
            // Samples along an edge tend to have residuals of one sign, so signs of samples have models.
            const bool negative = basis.cosines() ? coder.even(level < 0)
                                                  : coder.bit(models.sign[basis.cosines_u ? 0 : signs[row][column + 1]]
                                                                         [basis.cosines_v ? 0 : signs[row + 1][column]],
                                                              level < 0);
            level = negative ? -static_cast<std::int32_t>(magnitude) : static_cast<std::int32_t>(magnitude);
            signs[row][column] = negative ? 2 : 1;
        } else {
            level = 0;
            magnitude = 0;
        }
        magnitudes[row][column] = static_cast<std::uint8_t>(std::min(magnitude, std::uint32_t{in_last_class}));
    }
}

}  // namespace hogel::codec::format
