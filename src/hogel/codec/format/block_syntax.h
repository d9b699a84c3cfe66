// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hogel/codec/format/partitions.h"
#include "hogel/codec/format/prediction.h"
#include "hogel/coding/arithmetic.h"
#include "hogel/compress.h"

namespace hogel::codec::format {

using Levels = std::array<std::int32_t, block_samples>;

// What the levels of a channel of a block stand for: cosines along u and v, samples as they are, or along one axis
// cosines and along the other samples.
struct Basis {
    bool cosines_u, cosines_v;
    constexpr bool cosines() const { return cosines_u && cosines_v; }
    constexpr bool samples() const { return !cosines_u && !cosines_v; }
};
constexpr std::array<Basis, 4> bases{{{true, true}, {false, false}, {true, false}, {false, true}}};

// What a block of one hogel is told.
struct Block {
    // 0: from within the hogel; 1 + side: from other hogels; parted.
    std::uint8_t mode = 0;
    std::uint8_t within = 0;              // how, for mode 0
    std::uint8_t coded = 0;               // a bit for each channel that has levels
    std::array<std::uint8_t, 3> basis{};  // of each channel's levels
    std::int16_t disparity = 0;
    bool surprising = false;  // its disparity is not the likeliest
    // Of mode parted, what lies beyond a line; the main part has `disparity`.
    std::uint8_t line = 0;
    std::int16_t disparity_beyond = 0;
    std::array<std::uint8_t, 2> side{};  // of the main part, and beyond
};
constexpr int within_modes = 10, first_direction = 4;  // from there on as the edges go on along a direction
constexpr int across_modes = 1 + static_cast<int>(ReferenceWeights::sides);
constexpr std::uint8_t parted = across_modes;

struct Candidates;
struct CodedHogel {
    std::vector<Block> blocks;           // row by row
    std::vector<Levels> levels;          // of the coded channels of all blocks, in order
    std::vector<Candidates> candidates;  // of the blocks, where they are known already
};

// The blocks of a hogel, and what its place in the order makes of them.
struct BlockGrid {
    std::size_t columns, rows, channels;
    std::size_t count() const { return columns * rows; }
};

// The blocks of the tellers, moved to where they are seen from this hogel: one for each block, or null.
std::vector<const Block*> moved_blocks(const HogelOrder::Hogel& hogel, const std::vector<CodedHogel>& coded,
                                       const BlockGrid& grid, float aspect);

// Disparities that a block may have, the likeliest first; none twice. From what is moved here, and from the blocks
// before it.
struct Candidates {
    std::array<std::int16_t, 8> disparity{};
    std::size_t count = 0;
    bool contain(int value) const {
        bool found = false;  // without a way out, so that all are compared at once
        for (std::size_t k = 0; k < disparity.size(); ++k) found |= (k < count) & (disparity[k] == value);
        return found;
    }
    void add(int value) {
        const auto clamped = static_cast<std::int16_t>(std::clamp(value, -max_disparity, max_disparity));
        if (!contain(clamped)) disparity[count++] = clamped;
    }
    // How far they are from each other: 0 for not at all, 1 for nearly so, 2 for one surface, 3.
    std::size_t spread() const;
};
Candidates candidates_for(std::size_t block, const BlockGrid& grid, const std::vector<Block>& blocks,
                          const Block* moved, const std::vector<Block>* beside);

// The finest difference of disparity that matters to a hogel: a sixteenth of a direction, moved from the nearest
// reference to here.
int disparity_unit(const HogelOrder::Hogel& hogel);

// A number >= 0 as how many bits it has more than one, in unary (a model a place), and these bits.
constexpr std::size_t max_number_bits = 30;
template <class Coder, class Model>
std::uint32_t code_number(Coder& coder, std::array<Model, max_number_bits + 1>& models, std::uint32_t value) {
    const std::uint32_t one_more = value + 1;
    std::size_t bits = 0;
    while (bits < max_number_bits && coder.bit(models[bits], one_more >> (bits + 1) != 0)) ++bits;
    std::uint32_t result = 1;
    for (std::size_t k = bits; k-- > 0;) result = result << 1 | std::uint32_t{coder.even(one_more >> k & 1)};
    return result - 1;
}

// Levels are told by the sizes of those around them, in as many classes.
constexpr std::size_t level_classes = 12;

// A model for everything that is told, by what is known of it.
template <class Model>
struct ModelsOf {
    struct ForLevels {
        std::array<Model, block_samples> last;
        std::array<std::array<Model, 3>, level_classes> significant, beyond_one;  // by frequency
        std::array<Model, level_classes> beyond_two;
        std::array<std::array<Model, max_number_bits + 1>, level_classes> rest;
        std::array<std::array<Model, 3>, 3> sign;  // of samples, by those on the right and below
    };
    // What is told by the block that is moved here comes three times: for none, and for two sorts of such blocks.
    template <class Models>
    using ByMoved = std::array<Models, 3>;
    ByMoved<std::array<std::array<Model, across_modes>, 3>> mode;
    std::array<Model, within_modes - 1> within;
    struct ForDisparity {
        ByMoved<std::array<std::array<std::array<Model, 2>, 3>, 4>> disparity;  // by spread
        std::array<std::array<Model, 4>, 4> candidate;                          // by spread
        Model sign;
        std::array<Model, max_number_bits + 1> difference;
    };
    struct ForParts {
        ByMoved<std::array<Model, 3>> parted;
        std::array<std::array<Model, ReferenceWeights::sides - 1>, 2> side;
        std::array<Model, line_angles> angle;
        std::array<Model, line_places> place;
        ForDisparity beyond;
        ByMoved<std::array<std::array<std::array<Model, 3>, 2>, 2>> coded;  // as below
        // Of a line, by that of the parted block that is moved here: how far it is turned, its place.
        std::array<Model, line_angles> turn;
        std::array<std::array<Model, line_places>, line_places> place_by_moved;
    };
    ForDisparity main;
    // By luminance or chrominance, kind of mode, whether the disparity is surprising.
    ByMoved<std::array<std::array<std::array<std::array<Model, 3>, 2>, 3>, 2>> coded;
    // By luminance or chrominance, within or across; of levels by whether they are cosines, samples, or half of each.
    std::array<std::array<std::array<ForLevels, 3>, 2>, 2> levels;
    std::array<std::array<std::array<Model, bases.size() - 1>, 4>, 2> basis;  // and kind of mode, parted last

    ForParts parts;

    // All of them, in the order of the format.
    template <class Use>
    void for_each(Use&& use) {
        visit(use, mode[0], within);
        visit_disparity(use, main);
        visit(use, coded[0]);
        for (auto& of_channel : levels)
            for (auto& of_side : of_channel)
                for (ForLevels& l : of_side)
                    visit(use, l.last, l.significant, l.beyond_one, l.beyond_two, l.rest, l.sign);
        visit(use, basis);
        visit(use, parts.parted[0], parts.side, parts.angle, parts.place);
        visit_disparity(use, parts.beyond);
        visit(use, parts.coded[0]);
        for (std::size_t moved = 1; moved < mode.size(); ++moved) {
            visit(use, mode[moved], main.disparity[moved], coded[moved]);
            visit(use, parts.parted[moved], parts.beyond.disparity[moved], parts.coded[moved]);
        }
        visit(use, parts.turn, parts.place_by_moved);
    }

  private:
    template <class Use>
    static void visit(Use& use, Model& model) {
        use(model);
    }
    template <class Use, class Inner, std::size_t count>
    static void visit(Use& use, std::array<Inner, count>& models) {
        for (Inner& inner : models) visit(use, inner);
    }
    template <class Use>
    static void visit_disparity(Use& use, ForDisparity& models) {
        visit(use, models.disparity[0], models.candidate, models.sign, models.difference);
    }
    template <class Use, class First, class... More>
    requires(sizeof...(More) > 0) static void visit(Use& use, First& first, More&... more) {
        visit(use, first);
        visit(use, more...);
    }
};

// Adaptive ones.
using BlockModels = ModelsOf<coding::BitModel>;

// The number of each, in the order of for_each().
struct BlockModelNumbers : ModelsOf<std::uint16_t> {
    BlockModelNumbers() {
        std::uint16_t next = 0;
        for_each([&](std::uint16_t& number) { number = next++; });
    }
};

// Writes what blocks are told, or reads it, or records it, to be written when all of a level is known: the one
// description of all three. What writes returns what it is given.
class BlockRecorder {
  public:
    using Models = BlockModelNumbers;
    static constexpr bool reads = false;
    bool bit(std::uint16_t model, bool value) {
        record_.push_back(static_cast<std::uint16_t>(2 * model + value));
        return value;
    }
    bool even(bool value) {
        record_.push_back(static_cast<std::uint16_t>(even_bit + value));
        return value;
    }

    // Of each bit its model's number and what it is.
    using Record = std::vector<std::uint16_t>;
    Record finish() { return std::move(record_); }
    static constexpr std::uint16_t even_bit = 0xFFFE;

  private:
    Record record_;
};
// How often a bit of each model was 0, and 1.
using BitCount = std::array<std::uint32_t, 2>;
void count_bits(const BlockRecorder::Record& record, std::span<BitCount> counts);
std::vector<std::uint8_t> write_bits(const BlockRecorder::Record& record, std::vector<coding::BitModel> models);

class BlockWriter {
  public:
    using Models = BlockModels;
    static constexpr bool reads = false;
    bool bit(coding::BitModel& model, bool value) {
        encoder_.bit(model, value);
        return value;
    }
    bool even(bool value) {
        encoder_.raw(value, 1);
        return value;
    }
    std::vector<std::uint8_t> finish() { return encoder_.finish(); }

  private:
    coding::ArithmeticEncoder encoder_;
};

class BlockReader {
  public:
    using Models = BlockModels;
    static constexpr bool reads = true;
    explicit BlockReader(std::span<const std::uint8_t> bytes) : decoder_(bytes) {}
    bool bit(coding::BitModel& model, bool) { return decoder_.bit(model); }
    bool even(bool) { return decoder_.even(); }
    bool ended() const { return decoder_.ended(); }
    bool all_read() const { return decoder_.all_read(); }

  private:
    coding::ArithmeticDecoder decoder_;
};

// RawPixels all blocks of a hogel; a reader fills `coded`.
template <class Coder>
void code_hogel(Coder& coder, typename Coder::Models& models, const BlockGrid& grid, const HogelOrder::Hogel& hogel,
                const std::vector<const Block*>& moved, const std::vector<Block>* beside, CodedHogel& coded);

// A hogel of which nothing is told: every block as its likeliest disparity shows it.
void guess_hogel(const BlockGrid& grid, const std::vector<const Block*>& moved, const std::vector<Block>* beside,
                 CodedHogel& coded);

}  // namespace hogel::codec::format
