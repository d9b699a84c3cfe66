// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hogel/codec/encode/warped_blocks.h"

namespace hogel::codec::encode {

// Searches the best two partitions of a block: their predictions, and the edge between them.
class PartitionSearch {
  public:
    // @param warped   cache of warped blocks for the current block
    PartitionSearch(WarpedBlocks& warped, format::ReferenceWeights& weights) : warped_(warped), weights_(weights) {}

    // Starts with a block with the samples `target`, and tries its candidates as disparities of partitions.
    // @param rate_weight   λ, the squared error equivalent to one bit
    void begin(const format::BlockSamples& target, const format::Candidates& candidates, float rate_weight);
    void add(int disparity);
    // Returns the best partitions so far, or nullopt, and stores their prediction.
    std::optional<format::Block> best(format::BlockSamples& prediction);

  private:
    struct InterPrediction {
        std::int16_t disparity;
        std::uint8_t side;
    };
    void try_all_sides(int disparity, float bits);
    const format::BlockSamples& predict(InterPrediction from, format::BlockSamples& scratch) {
        return warped_.predict(from.disparity, choice(from), scratch);
    }
    const format::ReferenceWeights::Choice& choice(InterPrediction from) {
        return weights_.choose(from.disparity, static_cast<format::ReferenceWeights::Side>(from.side));
    }

    WarpedBlocks& warped_;
    format::ReferenceWeights& weights_;
    // The current block:
    const format::BlockSamples* target_ = nullptr;
    float rate_weight_ = 0;
    std::vector<InterPrediction> tried_;
    format::BestPerEdge main_, second_;
};

}  // namespace hogel::codec::encode
