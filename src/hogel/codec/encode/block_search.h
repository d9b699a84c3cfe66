// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>

#include "hogel/codec/encode/warped_blocks.h"

namespace hogel::codec::encode {

// Disparities of a hogel that are known before its blocks are coded.
struct KnownDisparities {
    std::span<const std::int16_t> estimated{};                   // one per block; may be empty
    std::span<const format::Block* const> warped{};              // the warped block of each block; may be empty
    const std::vector<format::Block>* context_blocks = nullptr;  // blocks of the first context reference; may be null
};

// Searches the disparity and side that best predict a block of the first channel. Choices with few bits are tried
// first. The search stops at a good enough prediction, and skips choices with bits that alone cost more than the best
// one.
class BlockSearch {
  public:
    // @param warped   cache of warped blocks for the current block
    BlockSearch(const format::TileSetup& setup, const format::HogelOrder::Hogel& hogel, const format::Plane& source,
                WarpedBlocks& warped, format::ReferenceWeights& weights, const KnownDisparities& known);
    BlockSearch(const BlockSearch&) = delete;
    BlockSearch& operator=(const BlockSearch&) = delete;

    struct Found {
        float cost = std::numeric_limits<float>::infinity();  // squared error plus λ times the bits
        float error = 0;                                      // Σ (prediction − target)²
        std::uint8_t mode = format::mode_intra;               // mode_intra: no prediction was found
        std::int16_t disparity = 0;
        const format::BlockSamples* prediction = nullptr;
    };
    // Searches for block k with the samples `target`. Valid until the next call.
    const Found& run(std::size_t k, const format::BlockSamples& target, const format::Candidates& candidates);
    const Found& found() const { return best_; }
    // Tries disparities around the best one, distant ones first. Returns whether a better one was found, which is then
    // the result.
    bool look_around();
    bool good() const { return best_.cost < good_enough_; }
    // Returns the minimum cost of blocks for which look_around() is worthwhile.
    float wide_search_cost() const { return wide_search_cost_; }

  private:
    bool may_win(float bits) const { return min_error_ + rate_weight_ * bits < best_.cost; }
    bool take_if_better(const format::BlockSamples& prediction, float error, float bits, int side, int disparity);
    void try_any_side(int disparity, float bits);
    void try_single_sides(int disparity, float bits);
    void follow_slopes();
    void try_nearby(std::size_t k, const format::Candidates& candidates);
    // Returns the nearest disparity that can be coded: one that differs from the first candidate by a whole number of
    // units.
    int codable(float disparity) const;

    const format::TileSetup& setup_;
    const format::HogelOrder::Hogel& hogel_;
    const format::Plane& source_;
    WarpedBlocks& warped_;
    format::ReferenceWeights& weights_;
    KnownDisparities known_;
    float rate_weight_, good_enough_, wide_search_cost_, min_error_;
    int unit_;

    // The current block:
    std::size_t x_ = 0, y_ = 0;
    const format::BlockSamples* target_ = nullptr;
    int first_candidate_ = 0;
    Found best_;
    std::array<format::BlockSamples, 2> predictions_;  // the best prediction, and scratch for the next one
    bool slopes_known_ = false;
    format::Slopes slopes_;
};

}  // namespace hogel::codec::encode
