// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/partition_search.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace hogel::codec::format {
namespace {

TEST(Partitions, main_partition_holds_the_middle) {
    for (std::size_t angle = 0; angle < edge_angles; ++angle) {
        const std::size_t opposite = (angle + edge_angles / 2) % edge_angles;
        // An edge through the middle has two names, which swap the partitions.
        EXPECT_EQ(partition_mask(edge_number(angle, 0)) & partition_mask(edge_number(opposite, 0)), 0u) << angle;
        for (std::size_t offset = 0; offset < edge_offsets; ++offset) {
            const std::size_t edge = edge_number(angle, offset);
            const std::uint64_t mask = partition_mask(edge);
            EXPECT_GT(std::popcount(mask), 0) << angle << ", " << offset;
            EXPECT_LE(std::popcount(mask), 32) << angle << ", " << offset;
            if (offset > 0) {
                const std::uint64_t nearer = partition_mask(edge_number(angle, offset - 1));
                EXPECT_EQ(mask & nearer, mask);
                EXPECT_NE(mask, nearer);
            }
            for (std::size_t n = 0; n < block_samples; ++n)
                EXPECT_EQ(
                    sample_in_cut(n % block_side, static_cast<std::size_t>(edge_row_cuts()[n / block_side][edge])),
                    (mask >> n & 1) != 0);
        }
    }
    // The second partition is the last column, and the last three rows.
    EXPECT_EQ(partition_mask(edge_number(0, 3)), 0x8080808080808080u);
    EXPECT_EQ(partition_mask(edge_number(8, 1)), 0xFFFFFF0000000000u);
}

// A surface with a disparity of two directions covers, from one column on, a surface with none.
TEST(Partitions, are_found_where_a_surface_ends) {
    constexpr int disparity = 2, edge = 13;
    const HogelOrder order(5, 1, 1, 1);
    const auto shown = [](int i, int u, int v) {
        const int on_near = u + disparity * i;
        return static_cast<float>(on_near >= edge ? 2 + std::sin(1.3 * on_near + v) : std::sin(0.9 * u - 2.0 * v));
    };
    std::vector<Picture> pictures(5);
    for (Picture& picture : pictures) picture.emplace_back(32, 8);
    for (std::size_t k = 0; k < 5; ++k)
        for (std::size_t n = 0; n < 256; ++n)
            pictures[k][0].samples[n] = shown(int(order.hogels()[k].s) - 1, int(n % 32), int(n / 32));
    const HogelOrder::Hogel& middle = order.hogels()[3];
    ASSERT_EQ(middle.s, 1u);
    const std::array<float, 5> noise{1, 1, 1, 1, 1};
    ReferenceWeights weights(middle, noise, 1);
    BlockSamples target, prediction;
    for (std::size_t n = 0; n < block_samples; ++n) target[n] = shown(0, 8 + int(n % 8), int(n / 8));
    Candidates candidates;
    candidates.add(0);
    candidates.add(disparity * shift_unit);
    encode::WarpedBlocks warped(middle, pictures);
    warped.go_to(8, 0);
    encode::PartitionSearch partitions(warped, weights);
    partitions.begin(target, candidates, 1e-4f);
    const auto block = partitions.best(prediction);
    ASSERT_TRUE(block);
    EXPECT_EQ(block->mode, mode_partitioned);
    EXPECT_EQ(partition_mask(block->edge), partition_mask(edge_number(0, 1)));
    EXPECT_EQ(block->disparity, 0);
    EXPECT_EQ(block->second_disparity, disparity * shift_unit);
    // Seen from the right, the near surface covers more of the far one.
    EXPECT_EQ(block->side[0], static_cast<int>(ReferenceWeights::Side::left));
    EXPECT_EQ(squared_difference(prediction, target), 0);
    ASSERT_TRUE(predict_partitions(pictures, middle, *block, choices_of(*block, weights), 0, 8, 0, prediction));
    EXPECT_EQ(squared_difference(prediction, target), 0);
}

}  // namespace
}  // namespace hogel::codec::format
