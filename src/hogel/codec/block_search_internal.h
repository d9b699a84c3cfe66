#pragma once

#include <limits>

#include "hogel/codec/analysis_internal.h"

namespace hogel {

// The search for what a block of the first channel is best predicted from: a disparity and sides. Tries what costs few
// bits first, stops at a prediction that is good enough, and leaves out what its bits alone keep from winning.
class BlockSearch {
  public:
    // @param pictures    of the hogels before this one in the order
    // @param estimated   disparities of the blocks; may be empty
    BlockSearch(const TileSetup& setup, const HogelOrder::Hogel& hogel, const Plane& source,
                const std::vector<Picture>& pictures, std::span<const std::int16_t> estimated, Effort effort);
    BlockSearch(const BlockSearch&) = delete;
    BlockSearch& operator=(const BlockSearch&) = delete;

    struct Found {
        float cost = std::numeric_limits<float>::infinity();  // error and bits, in squared samples
        float error = 0;                                      // Σ (prediction − wanted)²
        std::uint8_t mode = 0;                                // of Block; 0: nothing was found
        std::int16_t disparity = 0;
        const BlockSamples* prediction = nullptr;
    };
    // For block k, whose samples are `wanted`. Valid until the next call.
    const Found& run(std::size_t k, const BlockSamples& wanted, const Candidates& candidates);
    // The references of what was found.
    const ReferenceWeights::Choice& choice() {
        return weights_.choose(best_.disparity, static_cast<ReferenceWeights::Side>(best_.mode - 1));
    }
    // What was found is good enough not to look for anything else.
    bool good() const { return best_.cost < good_enough_; }

  private:
    bool may_win(float bits) const { return least_error_ + worth_ * bits < best_.cost; }
    // Stays as it is while less than `most_seen` others are looked at.
    const BlockSamples& seen(int disparity, std::uint32_t reference, Shift shift);
    bool take_if_better(const BlockSamples& prediction, float bits, int side, int disparity);
    void try_any_side(int disparity, float bits);
    void try_single_sides(int disparity, float bits);
    void follow_slopes(int likeliest);
    void look_around(int likeliest);

    const TileSetup& setup_;
    const HogelOrder::Hogel& hogel_;
    const Plane& source_;
    const std::vector<Picture>& pictures_;
    std::span<const std::int16_t> estimated_;
    Effort effort_;
    ReferenceWeights weights_;
    float worth_, good_enough_, worth_looking_, least_error_;
    int unit_;

    // Of the block that is searched for:
    std::size_t x_ = 0, y_ = 0;
    const BlockSamples* wanted_ = nullptr;
    Found best_;
    std::array<BlockSamples, 2> kept_;  // the best prediction, and the next one
    bool slopes_known_ = false;
    Slopes slopes_;
    // Blocks of references that were looked at, by disparity and reference.
    static constexpr std::size_t most_seen = 16;
    using SeenAs = std::pair<int, std::uint32_t>;
    std::array<SeenAs, most_seen> seen_as_;
    std::array<BlockSamples, most_seen> seen_;
    std::size_t seen_count_ = 0;
};

}  // namespace hogel
