// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/partition_search.h"

#include <algorithm>
#include <limits>

namespace hogel::codec::encode {

using namespace format;

namespace {

// Bits that things cost, about.
constexpr float likeliest_disparity = 0.3f, each_candidate = 1.5f, new_disparity = 14;
constexpr float best_of_all_sides = 1, one_side = 2.5f;

// Eight at once.
std::size_t cheapest_line(const BestOfLines& main, const BestOfLines& beyond) {
    OfLines cost;
    for (std::size_t line = 0; line < block_lines; ++line) cost[line] = main.cost[line] + beyond.cost[line];
    std::array<float, 8> least;
    std::copy_n(cost.begin(), least.size(), least.begin());
    for (std::size_t line = least.size(); line < block_lines; line += least.size())
        for (std::size_t n = 0; n < least.size(); ++n) least[n] = cost[line + n] < least[n] ? cost[line + n] : least[n];
    return static_cast<std::size_t>(std::ranges::find(cost, std::ranges::min(least)) - cost.begin());
}

}  // namespace

// All ways to predict a block with a disparity, as parts on either side of all lines.
void PartSearch::see(int disparity, float bits) {
    for (std::uint8_t side = 0; side < ReferenceWeights::sides; ++side) {
        const PropagationOptions way{static_cast<std::int16_t>(disparity), side};
        if (choice(way).count == 0) continue;
        BlockSamples room;
        const float cost = bit_ * (bits + (side == 0 ? best_of_all_sides : one_side));
        take_better(predict(way, room), *wanted_, cost, static_cast<float>(ways_.size()), lines_in_rows(), main_,
                    beyond_);
        ways_.push_back(way);
    }
}

void PartSearch::begin(const BlockSamples& wanted, const Candidates& candidates, float bit) {
    wanted_ = &wanted;
    bit_ = bit;
    ways_.clear();
    main_.cost.fill(std::numeric_limits<float>::infinity());
    beyond_.cost.fill(std::numeric_limits<float>::infinity());
    for (std::size_t k = 0; k < candidates.count; ++k)
        see(candidates.disparity[k], likeliest_disparity + each_candidate * static_cast<float>(k));
}

void PartSearch::add(int disparity) {
    if (std::ranges::none_of(ways_, [&](PropagationOptions way) { return way.disparity == disparity; }))
        see(disparity, new_disparity);
}

std::optional<Block> PartSearch::best(BlockSamples& prediction) {
    if (ways_.empty()) return std::nullopt;
    const std::size_t line = cheapest_line(main_, beyond_);
    const PropagationOptions main = ways_[static_cast<std::size_t>(main_.way[line])];
    const PropagationOptions beyond = ways_[static_cast<std::size_t>(beyond_.way[line])];
    BlockSamples room;
    prediction = predict(main, room);
    put_beyond(line, predict(beyond, room), prediction);
    Block block;
    block.mode = parted;
    block.line = static_cast<std::uint8_t>(line);
    block.disparity = main.disparity;
    block.disparity_beyond = beyond.disparity;
    block.side = {main.side, beyond.side};
    return block;
}

}  // namespace hogel::codec::encode
