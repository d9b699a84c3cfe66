// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/partition_search.h"

#include <algorithm>
#include <limits>

namespace hogel::codec::encode {

using namespace format;

namespace {

// Estimated bits.
constexpr float first_candidate_bits = 0.3f, each_candidate_bits = 1.5f, new_disparity_bits = 14;
constexpr float best_of_all_sides_bits = 1, one_side_bits = 2.5f;

// Returns the edge with the smallest sum of both partitions' costs. Compares eight edges at once.
std::size_t cheapest_edge(const BestPerEdge& main, const BestPerEdge& second) {
    PerEdge cost;
    for (std::size_t edge = 0; edge < block_edges; ++edge) cost[edge] = main.cost[edge] + second.cost[edge];
    std::array<float, 8> min_cost;
    std::copy_n(cost.begin(), min_cost.size(), min_cost.begin());
    for (std::size_t edge = min_cost.size(); edge < block_edges; edge += min_cost.size())
        for (std::size_t n = 0; n < min_cost.size(); ++n)
            min_cost[n] = cost[edge + n] < min_cost[n] ? cost[edge + n] : min_cost[n];
    return static_cast<std::size_t>(std::ranges::find(cost, std::ranges::min(min_cost)) - cost.begin());
}

}  // namespace

// Compares the predictions of all sides with both partitions of all edges.
void PartitionSearch::try_all_sides(int disparity, float bits) {
    for (std::uint8_t side = 0; side < ReferenceWeights::sides; ++side) {
        const InterPrediction from{static_cast<std::int16_t>(disparity), side};
        if (choice(from).count == 0) continue;
        BlockSamples scratch;
        const float cost = rate_weight_ * (bits + (side == 0 ? best_of_all_sides_bits : one_side_bits));
        keep_better(predict(from, scratch), *target_, cost, static_cast<float>(tried_.size()), edge_row_cuts(), main_,
                    second_);
        tried_.push_back(from);
    }
}

void PartitionSearch::begin(const BlockSamples& target, const Candidates& candidates, float rate_weight) {
    target_ = &target;
    rate_weight_ = rate_weight;
    tried_.clear();
    main_.cost.fill(std::numeric_limits<float>::infinity());
    second_.cost.fill(std::numeric_limits<float>::infinity());
    for (std::size_t k = 0; k < candidates.count; ++k)
        try_all_sides(candidates.disparity[k], first_candidate_bits + each_candidate_bits * static_cast<float>(k));
}

void PartitionSearch::add(int disparity) {
    if (std::ranges::none_of(tried_, [&](InterPrediction from) { return from.disparity == disparity; }))
        try_all_sides(disparity, new_disparity_bits);
}

std::optional<Block> PartitionSearch::best(BlockSamples& prediction) {
    if (tried_.empty()) return std::nullopt;
    const std::size_t edge = cheapest_edge(main_, second_);
    const InterPrediction main = tried_[static_cast<std::size_t>(main_.choice[edge])];
    const InterPrediction second = tried_[static_cast<std::size_t>(second_.choice[edge])];
    BlockSamples scratch;
    prediction = predict(main, scratch);
    put_second_partition(edge, predict(second, scratch), prediction);
    Block block;
    block.mode = mode_partitioned;
    block.edge = static_cast<std::uint8_t>(edge);
    block.disparity = main.disparity;
    block.second_disparity = second.disparity;
    block.side = {main.side, second.side};
    return block;
}

}  // namespace hogel::codec::encode
