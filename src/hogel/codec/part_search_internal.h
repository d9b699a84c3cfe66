#pragma once

#include <optional>

#include "hogel/codec/reconstruct_internal.h"

namespace hogel {

// Looks for two parts of a block: how each is best predicted from other hogels, and which line is between them.
class PartSearch {
  public:
    PartSearch(const HogelOrder::Hogel& hogel, const std::vector<Picture>& pictures, ReferenceWeights& weights)
        : hogel_(hogel), pictures_(pictures), weights_(weights) {}

    // The best parts of a block at (x, y) that shows `wanted` in its first channel, if there are any.
    // @param disparity   one that does well for the whole block, beside its candidates
    // @param bit         what a bit is worth, in squared error
    std::optional<Block> run(std::size_t x, std::size_t y, const BlockSamples& wanted, const Candidates& candidates,
                             int disparity, float bit);

  private:
    struct Way {
        std::int16_t disparity;
        std::uint8_t side;
    };
    void see(std::size_t x, std::size_t y, const BlockSamples& wanted, int disparity, float bits);

    const HogelOrder::Hogel& hogel_;
    const std::vector<Picture>& pictures_;
    ReferenceWeights& weights_;
    // Of the block looked at:
    float bit_ = 0;
    std::vector<Way> ways_;
    BestOfLines main_, beyond_;
};

}  // namespace hogel
