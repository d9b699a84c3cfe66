#include "hogel/codec/part_search_internal.h"

#include <algorithm>
#include <limits>

namespace hogel {
namespace {

// Bits that things cost, about.
constexpr float likeliest_disparity = 0.3f, each_candidate = 1.5f, new_disparity = 14;
constexpr float best_of_all_sides = 1, one_side = 2.5f;

}  // namespace

// All ways to predict a block with a disparity, as parts on either side of all lines.
void PartSearch::see(std::size_t x, std::size_t y, const BlockSamples& wanted, int disparity, float bits) {
    // What one reference shows may serve for all sides and for its own.
    std::array<BlockSamples, ReferenceWeights::sides + 1> seen;
    std::array<std::uint32_t, ReferenceWeights::sides + 1> seen_of;
    std::size_t seen_count = 0;
    const auto fetch = [&](const ReferenceWeights::Choice& choice, std::size_t k) -> const BlockSamples& {
        const auto end = seen_of.begin() + seen_count;
        const auto found = std::find(seen_of.begin(), end, choice.reference[k]);
        if (found != end) return seen[static_cast<std::size_t>(found - seen_of.begin())];
        const Plane& plane = pictures_[hogel_.references[choice.reference[k]].hogel][0];
        fetch_moved(plane, static_cast<int>(x), static_cast<int>(y), choice.shift[k], seen[seen_count]);
        seen_of[seen_count] = choice.reference[k];
        return seen[seen_count++];
    };
    for (std::uint8_t side = 0; side < ReferenceWeights::sides; ++side) {
        const auto& choice = weights_.choose(disparity, static_cast<ReferenceWeights::Side>(side));
        if (choice.count == 0) continue;
        const BlockSamples* prediction = &fetch(choice, 0);
        BlockSamples mixed;
        if (choice.count == 2) {
            mix_blocks(*prediction, fetch(choice, 1), choice.weight[0], choice.weight[1], mixed);
            prediction = &mixed;
        }
        const float cost = bit_ * (bits + (side == 0 ? best_of_all_sides : one_side));
        take_better(*prediction, wanted, cost, static_cast<float>(ways_.size()), lines_in_rows(), main_, beyond_);
        ways_.push_back({static_cast<std::int16_t>(disparity), side});
    }
}

std::optional<Block> PartSearch::run(std::size_t x, std::size_t y, const BlockSamples& wanted,
                                     const Candidates& candidates, int disparity, float bit) {
    bit_ = bit;
    ways_.clear();
    main_.cost.fill(std::numeric_limits<float>::infinity());
    beyond_.cost.fill(std::numeric_limits<float>::infinity());
    for (std::size_t k = 0; k < candidates.count; ++k)
        see(x, y, wanted, candidates.disparity[k], likeliest_disparity + each_candidate * static_cast<float>(k));
    if (!candidates.contain(disparity)) see(x, y, wanted, disparity, new_disparity);
    if (ways_.empty()) return std::nullopt;
    std::size_t best = 0;
    for (std::size_t line = 1; line < block_lines; ++line)
        if (main_.cost[line] + beyond_.cost[line] < main_.cost[best] + beyond_.cost[best]) best = line;
    const Way main = ways_[static_cast<std::size_t>(main_.way[best])];
    const Way beyond = ways_[static_cast<std::size_t>(beyond_.way[best])];
    Block block;
    block.mode = parted;
    block.line = static_cast<std::uint8_t>(best);
    block.disparity = main.disparity;
    block.disparity_beyond = beyond.disparity;
    block.side = {main.side, beyond.side};
    return block;
}

}  // namespace hogel
