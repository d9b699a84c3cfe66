// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>

#include "hogel/codec/encode/warped_blocks.h"

namespace hogel::codec::encode {

// Disparities that are known of a hogel before its blocks are coded.
struct KnownDisparities {
    std::span<const std::int16_t> estimated{};                   // of its blocks; may be empty
    std::span<const format::Block* const> warped{};              // the warped blocks; may be empty
    const std::vector<format::Block>* context_blocks = nullptr;  // of the first context reference; may be null
};

// The search for the disparity and side that predict a block of the first channel best. It tries what costs few bits
// first, stops at a prediction that is good enough, and leaves out what cannot win because of its bits alone.
class BlockSearch {
  public:
    // @param warped   cache of the block that is searched
    BlockSearch(const format::TileSetup& setup, const format::HogelOrder::Hogel& hogel, const format::Plane& source,
                WarpedBlocks& warped, format::ReferenceWeights& weights, const KnownDisparities& known);
    BlockSearch(const BlockSearch&) = delete;
    BlockSearch& operator=(const BlockSearch&) = delete;

    struct Found {
        float cost = std::numeric_limits<float>::infinity();  // squared error, and bits times their weight
        float error = 0;                                      // Σ (prediction − target)²
        std::uint8_t mode = format::mode_intra;               // intra: nothing was found
        std::int16_t disparity = 0;
        const format::BlockSamples* prediction = nullptr;
    };
    // Searches for block k, whose samples are `target`. Valid until the next call.
    const Found& run(std::size_t k, const format::BlockSamples& target, const format::Candidates& candidates);
    const Found& found() const { return best_; }
    // Tries disparities around the one that was found, far ones first. Returns whether one is better, which is found
    // then.
    bool look_around();
    // Whether what was found is good enough to stop.
    bool good() const { return best_.cost < good_enough_; }
    // A block that costs more than this in the end is worth looking around.
    float worth_looking() const { return worth_looking_; }

  private:
    bool may_win(float bits) const { return min_error_ + rate_weight_ * bits < best_.cost; }
    bool take_if_better(const format::BlockSamples& prediction, float error, float bits, int side, int disparity);
    void try_any_side(int disparity, float bits);
    void try_single_sides(int disparity, float bits);
    void follow_slopes();
    void try_nearby(std::size_t k, const format::Candidates& candidates);
    // The nearest disparity that can be coded: a whole number of units from the first candidate.
    int codable(float disparity) const;

    const format::TileSetup& setup_;
    const format::HogelOrder::Hogel& hogel_;
    const format::Plane& source_;
    WarpedBlocks& warped_;
    format::ReferenceWeights& weights_;
    KnownDisparities known_;
    float rate_weight_, good_enough_, worth_looking_, min_error_;
    int unit_;

    // The block that is searched:
    std::size_t x_ = 0, y_ = 0;
    const format::BlockSamples* target_ = nullptr;
    int first_candidate_ = 0;
    Found best_;
    std::array<format::BlockSamples, 2> kept_;  // the best prediction, and room for the next one
    bool slopes_known_ = false;
    format::Slopes slopes_;
};

}  // namespace hogel::codec::encode
