// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "hogel/coding/arithmetic.h"

namespace hogel::zerotrees {

// Arithmetic coding of the symbols of the three-pass coder: bit by bit in contexts, or from the alphabets of [K].
// Encoder and decoder share the code: bit(model, value), even(value), raw(value, count) and symbol(model, value) of a
// coder write their argument, or read a value, and return it.

constexpr int max_planes = 30;

// Models of the bits of symbols.
struct ThreePassModels {
    using Unary = std::array<coding::BitModel, max_planes>;
    static constexpr std::size_t contexts = 6;  // contexts of the two previous coefficients
    // [bits of the parent's subtree][leaf][context]
    std::array<std::array<std::array<coding::BitModel, contexts>, 2>, max_planes + 1> tree_found;
    std::array<std::array<std::array<Unary, contexts>, 2>, max_planes + 1> tree_less;
    // [bits of the subtree][context]
    std::array<std::array<coding::BitModel, contexts>, max_planes + 1> node_found;
    std::array<Unary, max_planes + 1> node_less;
    std::array<Unary, max_planes + 1> magnitude;  // [bits of the level][index of the bit]
};

// Symbols coded bit by bit.
template <class Coder>
class BitSymbols {
  public:
    BitSymbols(Coder of, int) : coder(std::move(of)), models_(std::make_unique<ThreePassModels>()) {}

    int tree(int symbol, int above, bool leaf) {
        // Large coefficients are likely next to each other.
        const std::size_t size_class = previous_tree_ == 0 ? 0u : previous_tree_ < above ? 1u : 2u;
        context_ = 2 * size_class + (second_previous_tree_ > 0 ? 1u : 0u);
        const auto up = static_cast<std::size_t>(above);
        if (!coder.bit(models_->tree_found[up][leaf][context_], symbol >= 0))
            symbol = -1;
        else
            symbol = unary(models_->tree_less[up][leaf][context_], symbol, above);
        second_previous_tree_ = previous_tree_;
        previous_tree_ = symbol < 0 ? 0 : above - symbol;
        return symbol;
    }
    int node(int symbol, int tree_bits) {
        const auto tree = static_cast<std::size_t>(tree_bits);
        if (!coder.bit(models_->node_found[tree][context_], symbol >= 0)) return -1;
        return unary(models_->node_less[tree], symbol, tree_bits);
    }
    std::pair<std::uint32_t, bool> magnitude(std::uint32_t level, int bits, bool negative) {
        negative = coder.even(negative);
        std::uint32_t result = 1;
        for (int bit_index = bits - 2; bit_index >= 0; --bit_index)
            result = result << 1 |
                     std::uint32_t{coder.bit(
                         models_->magnitude[static_cast<std::size_t>(bits)][static_cast<std::size_t>(bit_index)],
                         (level >> bit_index & 1) != 0)};
        return {result, negative};
    }

    Coder coder;

  private:
    // Codes a symbol from 0 to count − 1.
    int unary(ThreePassModels::Unary& models, int symbol, int count) {
        int result = 0;
        while (result + 1 < count && coder.bit(models[static_cast<std::size_t>(result)], symbol > result)) ++result;
        return result;
    }

    std::unique_ptr<ThreePassModels> models_;
    std::size_t context_ = 0;
    int previous_tree_ = 0, second_previous_tree_ = 0;  // bits of the last two subtrees
};

// Symbols as in [K] 4.4.2: Δp_t and Δp_n each from an alphabet of the numbers −1 to b_max − 1, a bit for the sign, and
// b_max − p_n − 1 uncoded bits of the magnitude.
template <class Coder>
class AlphabetSymbols {
  public:
    AlphabetSymbols(Coder of, int planes)
        : coder(std::move(of)),
          tree_(static_cast<std::size_t>(planes) + 1),
          node_(static_cast<std::size_t>(planes) + 1) {}

    // Numbers that no encoder writes are clamped, so that damaged codes stay harmless.
    int tree(int symbol, int above, bool) { return std::min(coded(tree_, symbol), above - 1); }
    int node(int symbol, int tree_bits) { return std::min(coded(node_, symbol), tree_bits - 1); }
    std::pair<std::uint32_t, bool> magnitude(std::uint32_t level, int bits, bool negative) {
        negative = coder.even(negative);
        const std::uint32_t leading = std::uint32_t{1} << (bits - 1);
        return {leading | coder.raw(level & (leading - 1), bits - 1), negative};
    }

    Coder coder;

  private:
    int coded(coding::SymbolModel& model, int symbol) {
        const int index = symbol + 1;
        return static_cast<int>(coder.symbol(model, static_cast<std::size_t>(index))) - 1;
    }

    coding::SymbolModel tree_, node_;
};

struct SymbolEncoder {
    coding::ArithmeticEncoder encoder;
    bool bit(coding::BitModel& model, bool value) {
        encoder.bit(model, value);
        return value;
    }
    bool even(bool value) {
        encoder.raw(value, 1);
        return value;
    }
    std::uint32_t raw(std::uint32_t value, int count) {
        encoder.raw(value, count);
        return value;
    }
    std::size_t symbol(coding::SymbolModel& model, std::size_t value) {
        encoder.symbol(model, value);
        return value;
    }
};

struct SymbolDecoder {
    coding::ArithmeticDecoder decoder;
    bool bit(coding::BitModel& model, bool) { return decoder.bit(model); }
    bool even(bool) { return decoder.even(); }
    std::uint32_t raw(std::uint32_t, int count) { return decoder.raw(count); }
    std::size_t symbol(coding::SymbolModel& model, std::size_t) { return decoder.symbol(model); }
};

// Sink of write_three_pass().
template <template <class> class Symbols>
struct Encoding {
    Symbols<SymbolEncoder> symbols;

    explicit Encoding(int planes) : symbols(SymbolEncoder{}, planes) {}
    void tree(int symbol, int above, bool leaf) { symbols.tree(symbol, above, leaf); }
    void node(int symbol, int tree_bits) { symbols.node(symbol, tree_bits); }
    void magnitude(std::uint32_t level, int bits, bool negative) { symbols.magnitude(level, bits, negative); }
};

// Source of read_three_pass().
template <template <class> class Symbols>
struct Decoding {
    Symbols<SymbolDecoder> symbols;

    Decoding(int planes, std::span<const std::uint8_t> code)
        : symbols(SymbolDecoder{coding::ArithmeticDecoder(code)}, planes) {}
    const coding::ArithmeticDecoder& decoder() const { return symbols.coder.decoder; }
    // After the end of a truncated stream every tree is a zerotree, so that the passes end soon.
    int tree(int above, bool leaf) { return decoder().ended() ? -1 : symbols.tree(0, above, leaf); }
    int node(int tree_bits) { return symbols.node(0, tree_bits); }
    std::pair<std::uint32_t, bool> magnitude(int bits) { return symbols.magnitude(0, bits, false); }
};

}  // namespace hogel::zerotrees
