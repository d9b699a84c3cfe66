// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hogel/codec/encode/warped_blocks.h"

namespace hogel::codec::encode {

// Looks for two parts of a block: how each is best predicted from other hogels, and which line is between them.
class PartSearch {
  public:
    // @param seen   of the block that is looked at
    PartSearch(SeenBlocks& seen, format::ReferenceWeights& weights) : seen_(seen), weights_(weights) {}

    // Begins with a block that shows `wanted`, and its candidates as disparities of parts.
    // @param bit   what a bit is worth, in squared error
    void begin(const format::BlockSamples& wanted, const format::Candidates& candidates, float bit);
    // One more disparity that parts may have.
    void add(int disparity);
    // The best parts so far, if there are any, and what they predict.
    std::optional<format::Block> best(format::BlockSamples& prediction);

  private:
    struct PropagationOptions {
        std::int16_t disparity;
        std::uint8_t side;
    };
    void see(int disparity, float bits);
    const format::BlockSamples& predict(PropagationOptions way, format::BlockSamples& room) {
        return seen_.predict(way.disparity, choice(way), room);
    }
    const format::ReferenceWeights::Choice& choice(PropagationOptions way) {
        return weights_.choose(way.disparity, static_cast<format::ReferenceWeights::Side>(way.side));
    }

    SeenBlocks& seen_;
    format::ReferenceWeights& weights_;
    // Of the block looked at:
    const format::BlockSamples* wanted_ = nullptr;
    float bit_ = 0;
    std::vector<PropagationOptions> ways_;
    format::BestOfLines main_, beyond_;
};

}  // namespace hogel::codec::encode
