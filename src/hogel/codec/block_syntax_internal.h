#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hogel/codec/prediction_internal.h"
#include "hogel/coding/arithmetic.h"

namespace hogel {

using Levels = std::array<std::int32_t, block_samples>;

// What a block of one hogel is told.
struct Block {
    // 0: from within the hogel; 1 + side: from other hogels.
    std::uint8_t mode = 0;
    std::uint8_t within = 0;  // how, for mode 0
    std::uint8_t coded = 0;   // a bit for each channel that has levels
    std::int16_t disparity = 0;
    bool surprising = false;  // its disparity is not the likeliest
};
constexpr int within_modes = 4, across_modes = 1 + static_cast<int>(ReferenceWeights::sides);

struct CodedHogel {
    std::vector<Block> blocks;   // row by row
    std::vector<Levels> levels;  // of the coded channels of all blocks, in order
};

// The blocks of a hogel, and what its place in the order makes of them.
struct BlockGrid {
    std::size_t columns, rows, channels;
    std::size_t count() const { return columns * rows; }
};

// The disparities of the references, moved to where they are seen from this hogel: one for each block, where any is.
std::vector<std::optional<std::int16_t>> moved_disparities(const HogelOrder::Hogel& hogel,
                                                           const std::vector<CodedHogel>& coded, const BlockGrid& grid,
                                                           float aspect);

// Disparities that a block may have, the likeliest first; none twice. From what is moved here, and from the blocks
// before it.
struct Candidates {
    std::array<std::int16_t, 5> disparity{};
    std::size_t count = 0;
    void add(int value);
    // How far they are from each other: 0 for not at all, 1 for nearly so, 2 for one surface, 3.
    std::size_t spread() const;
};
Candidates candidates_for(std::size_t block, const BlockGrid& grid, const std::vector<Block>& blocks,
                          const std::optional<std::int16_t>& moved, const std::vector<Block>* beside);

// The finest difference of disparity that matters to a hogel: a sixteenth of a direction, moved from the nearest
// reference to here.
int disparity_unit(const HogelOrder::Hogel& hogel);

// Adaptive models of everything that is told.
struct BlockModels {
    static constexpr int most_bits = 30;
    struct ForLevels {
        std::array<BitModel, block_samples> last;
        std::array<std::array<BitModel, 6>, 8> significant;
        std::array<BitModel, 8> beyond_one, beyond_two;
        std::array<BitModel, most_bits + 1> rest;
    };
    std::array<std::array<BitModel, across_modes>, 3> mode;
    std::array<BitModel, 3> within;
    std::array<std::array<std::array<BitModel, 2>, 3>, 4> disparity;  // by spread
    std::array<std::array<BitModel, 4>, 4> candidate;                 // by spread
    BitModel sign;
    std::array<BitModel, most_bits + 1> difference;
    // By luminance or chrominance, kind of mode, whether the disparity is surprising.
    std::array<std::array<std::array<std::array<BitModel, 3>, 2>, 3>, 2> coded;
    std::array<std::array<ForLevels, 2>, 2> levels;  // by luminance or chrominance, within or across
};

// Writes what blocks are told, or reads it: the one description of both. A writer's functions return what they are
// given.
class BlockWriter {
  public:
    bool bit(BitModel& model, bool value) {
        encoder_.bit(model, value);
        return value;
    }
    bool even(bool value) {
        encoder_.raw(value, 1);
        return value;
    }
    std::vector<std::uint8_t> finish() { return encoder_.finish(); }

  private:
    ArithmeticEncoder encoder_;
};

class BlockReader {
  public:
    explicit BlockReader(std::span<const std::uint8_t> bytes) : decoder_(bytes) {}
    bool bit(BitModel& model, bool) { return decoder_.bit(model); }
    bool even(bool) { return decoder_.raw(1) != 0; }
    bool ended() const { return decoder_.ended(); }
    bool all_read() const { return decoder_.all_read(); }

  private:
    ArithmeticDecoder decoder_;
};

// Codes all blocks of a hogel; a reader fills `coded`. `first` says that it is the tile's first, which has no others to
// be predicted from.
template <class Coder>
void code_hogel(Coder& coder, BlockModels& models, const BlockGrid& grid, const HogelOrder::Hogel& hogel,
                const std::vector<std::optional<std::int16_t>>& moved, const std::vector<Block>* beside,
                CodedHogel& coded);
extern template void code_hogel(BlockWriter&, BlockModels&, const BlockGrid&, const HogelOrder::Hogel&,
                                const std::vector<std::optional<std::int16_t>>&, const std::vector<Block>*,
                                CodedHogel&);
extern template void code_hogel(BlockReader&, BlockModels&, const BlockGrid&, const HogelOrder::Hogel&,
                                const std::vector<std::optional<std::int16_t>>&, const std::vector<Block>*,
                                CodedHogel&);

}  // namespace hogel
