// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "hogel/codec/format/block_models.h"
#include "hogel/codec/format/hogel_order.h"

namespace hogel::codec::format {

using Levels = std::array<std::int32_t, block_samples>;

struct Block {
    std::uint8_t mode = mode_intra;
    std::uint8_t intra_predictor = 0;     // if intra
    std::uint8_t coded = 0;               // one bit per channel: whether it has levels
    std::array<std::uint8_t, 3> basis{};  // per channel, an index of `bases`
    std::int16_t disparity = 0;           // main disparity
    bool not_first = false;               // the main disparity is not the first predictor candidate
    // Partitioned blocks only:
    std::uint8_t edge = 0;
    std::int16_t second_disparity = 0;
    std::array<std::uint8_t, 2> side{};  // sides from which the main and the second partition are predicted
};

struct Candidates;
struct CodedHogel {
    std::vector<Block> blocks;           // row-major
    std::vector<Levels> levels;          // of all coded channels of all blocks, in coding order
    std::vector<Candidates> candidates;  // one per block, if the encoder has already computed them
};

// Blocks of a hogel, row-major.
struct BlockGrid {
    std::size_t columns, rows, channels;
    std::size_t count() const { return columns * rows; }
};

// Warps the blocks of the context references along their disparities to this hogel. Returns one block, or null, for
// each block of this hogel.
std::vector<const Block*> warped_blocks(const HogelOrder::Hogel& hogel, const std::vector<CodedHogel>& coded,
                                        const BlockGrid& grid, float aspect);

// Disparities that a block is likely to have, most likely first, without repetition.
struct Candidates {
    std::array<std::int16_t, 8> disparity{};
    std::size_t count = 0;
    bool contain(int value) const {
        bool found = false;  // no early exit, so that the comparisons vectorise
        for (std::size_t k = 0; k < disparity.size(); ++k) found |= (k < count) & (disparity[k] == value);
        return found;
    }
    void add(int value) {
        const auto clamped = static_cast<std::int16_t>(std::clamp(value, -max_disparity, max_disparity));
        if (!contain(clamped)) disparity[count++] = clamped;
    }
    // Returns the class of the largest difference from the first candidate: 0 none, 1 up to 2, 2 up to 12 (one
    // surface), 3 more.
    std::size_t spread() const;
};

// Returns the predictor candidates of a block.
// @param blocks           blocks of the same hogel, known up to the current one
// @param warped           the warped block, or null
// @param context_blocks   the blocks of the first context reference, or null
Candidates predictor_candidates(std::size_t block, const BlockGrid& grid, const std::vector<Block>& blocks,
                                const Block* warped, const std::vector<Block>* context_blocks);

// Returns the unit in which disparities of a hogel are coded: the one that shifts a block by a sixteenth of a direction
// in the nearest reference.
int disparity_unit(const HogelOrder::Hogel& hogel);

// Codes a number n >= 0 (Exp-Golomb): the number of bits of n + 1 below its leading one, in unary with a model for each
// digit, then these bits.
template <class Coder, class Model>
std::uint32_t code_number(Coder& coder, std::array<Model, max_number_bits + 1>& models, std::uint32_t value) {
    const std::uint32_t one_more = value + 1;
    std::size_t bits = 0;
    while (bits < max_number_bits && coder.bit(models[bits], one_more >> (bits + 1) != 0)) ++bits;
    std::uint32_t result = 1;
    for (std::size_t k = bits; k-- > 0;) result = result << 1 | std::uint32_t{coder.even(one_more >> k & 1)};
    return result - 1;
}

// Records syntax elements, to be written once the layer is complete. The same functions write, read and record syntax
// elements: each takes a coder and a value and returns the value; a reader ignores its argument.
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

    // For each bit, 2 · index of its model + its value.
    using Record = std::vector<std::uint16_t>;
    Record finish() { return std::move(record_); }
    static constexpr std::uint16_t even_bit = 0xFFFE;

  private:
    Record record_;
};
// Numbers of zeros and of ones coded with a model.
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

// Codes the syntax elements of all blocks of a hogel; a reader fills `coded`.
template <class Coder>
void code_hogel(Coder& coder, typename Coder::Models& models, const BlockGrid& grid, const HogelOrder::Hogel& hogel,
                const std::vector<const Block*>& warped, const std::vector<Block>* context_blocks, CodedHogel& coded);

// Sets the syntax elements of a hogel in a layer that is not decoded: every block is predicted from any side with its
// first candidate and has no levels.
void predict_syntax(const BlockGrid& grid, const std::vector<const Block*>& warped,
                    const std::vector<Block>* context_blocks, CodedHogel& coded);

}  // namespace hogel::codec::format
