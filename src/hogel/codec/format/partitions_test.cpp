// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/partition_search.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace hogel::codec::format {
namespace {

TEST(Parts, main_part_holds_the_middle) {
    for (std::size_t angle = 0; angle < line_angles; ++angle) {
        const std::size_t opposite = (angle + line_angles / 2) % line_angles;
        // Through the middle there are two ways to name a line.
        EXPECT_EQ(samples_beyond(line_number(angle, 0)) & samples_beyond(line_number(opposite, 0)), 0u) << angle;
        for (std::size_t place = 0; place < line_places; ++place) {
            const std::size_t line = line_number(angle, place);
            const std::uint64_t beyond = samples_beyond(line);
            EXPECT_GT(std::popcount(beyond), 0) << angle << ", " << place;
            EXPECT_LE(std::popcount(beyond), 32) << angle << ", " << place;
            if (place > 0) {
                const std::uint64_t nearer = samples_beyond(line_number(angle, place - 1));
                EXPECT_EQ(beyond & nearer, beyond);
                EXPECT_NE(beyond, nearer);
            }
            for (std::size_t n = 0; n < block_samples; ++n)
                EXPECT_EQ(
                    sample_in_cut(n % block_side, static_cast<std::size_t>(lines_in_rows()[n / block_side][line])),
                    (beyond >> n & 1) != 0);
        }
    }
    // The last column; the last three rows.
    EXPECT_EQ(samples_beyond(line_number(0, 3)), 0x8080808080808080u);
    EXPECT_EQ(samples_beyond(line_number(8, 1)), 0xFFFFFF0000000000u);
}

// A surface that moves by two directions from hogel to hogel covers one that does not move, from a column on.
TEST(Parts, are_found_where_a_surface_ends) {
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
    BlockSamples wanted, prediction;
    for (std::size_t n = 0; n < block_samples; ++n) wanted[n] = shown(0, 8 + int(n % 8), int(n / 8));
    Candidates candidates;
    candidates.add(0);
    candidates.add(disparity * shift_unit);
    encode::SeenBlocks seen(middle, pictures);
    seen.go_to(8, 0);
    encode::PartSearch parts(seen, weights);
    parts.begin(wanted, candidates, 1e-4f);
    const auto block = parts.best(prediction);
    ASSERT_TRUE(block);
    EXPECT_EQ(block->mode, parted);
    EXPECT_EQ(samples_beyond(block->line), samples_beyond(line_number(0, 1)));
    EXPECT_EQ(block->disparity, 0);
    EXPECT_EQ(block->disparity_beyond, disparity * shift_unit);
    // To the right the near surface covers more of what is behind.
    EXPECT_EQ(block->side[0], static_cast<int>(ReferenceWeights::Side::left));
    EXPECT_EQ(squared_difference(prediction, wanted), 0);
    ASSERT_TRUE(predict_parts(pictures, middle, *block, choices_of(*block, weights), 0, 8, 0, prediction));
    EXPECT_EQ(squared_difference(prediction, wanted), 0);
}

}  // namespace
}  // namespace hogel::codec::format
