// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "hogel/codec/encode/analysis.h"
#include "hogel/codec/encode/warped_blocks.h"

namespace hogel::codec::encode {

// The search for what a block of the first channel is best predicted from: a disparity and sides. Tries what costs few
// bits first, stops at a prediction that is good enough, and leaves out what its bits alone keep from winning.
class BlockSearch {
  public:
    // Disparities that are known before blocks are told.
    struct Known {
        std::span<const std::int16_t> estimated{};           // of the blocks; may be empty
        std::span<const format::Block* const> moved{};       // moved to the blocks of this hogel; may be empty
        const std::vector<format::Block>* beside = nullptr;  // of the first teller; may be null
    };
    // @param seen   of the block that is searched for
    BlockSearch(const format::TileSetup& setup, const format::HogelOrder::Hogel& hogel, const format::Plane& source,
                SeenBlocks& seen, format::ReferenceWeights& weights, const Known& known);
    BlockSearch(const BlockSearch&) = delete;
    BlockSearch& operator=(const BlockSearch&) = delete;

    struct Found {
        float cost = std::numeric_limits<float>::infinity();  // error and bits, in squared samples
        float error = 0;                                      // Σ (prediction − wanted)²
        std::uint8_t mode = 0;                                // of Block; 0: nothing was found
        std::int16_t disparity = 0;
        const format::BlockSamples* prediction = nullptr;
    };
    // For block k, whose samples are `wanted`. Valid until the next call.
    const Found& run(std::size_t k, const format::BlockSamples& wanted, const format::Candidates& candidates);
    // Farther and then nearer around what was found. True if there is something better, which is found then.
    bool look_around();
    // What was found is good enough not to look for anything else.
    bool good() const { return best_.cost < good_enough_; }
    // What costs more than this in the end is worth looking around.
    float worth_looking() const { return worth_looking_; }

  private:
    bool may_win(float bits) const { return min_error_ + worth_ * bits < best_.cost; }
    bool take_if_better(const format::BlockSamples& prediction, float error, float bits, int side, int disparity);
    void try_any_side(int disparity, float bits);
    void try_single_sides(int disparity, float bits);
    void follow_slopes();
    void try_nearby(std::size_t k, const format::Candidates& candidates);
    // What is not a candidate is told in units from the likeliest.
    int told_as(float disparity) const;

    const format::TileSetup& setup_;
    const format::HogelOrder::Hogel& hogel_;
    const format::Plane& source_;
    SeenBlocks& seen_;
    format::ReferenceWeights& weights_;
    Known known_;
    float worth_, good_enough_, worth_looking_, min_error_;
    int unit_;

    // Of the block that is searched for:
    std::size_t x_ = 0, y_ = 0;
    const format::BlockSamples* wanted_ = nullptr;
    int likeliest_ = 0;
    Found best_;
    std::array<format::BlockSamples, 2> kept_;  // the best prediction, and the next one
    bool slopes_known_ = false;
    format::Slopes slopes_;
};

}  // namespace hogel::codec::encode
