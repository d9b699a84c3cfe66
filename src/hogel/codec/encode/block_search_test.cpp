// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/block_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace hogel::codec::encode {

using namespace format;

namespace {

// Five by five hogels that see a texture at one disparity. The last hogel is searched; the others are coded.
struct Views {
    TileSetup setup{HogelOrder(5, 5, 1, 1), 32, 32, 1, 0.003f, 1.35f, 1};
    std::vector<Picture> pictures;
    const HogelOrder::Hogel& hogel = setup.order.hogels().back();

    explicit Views(double disparity) {
        for (const HogelOrder::Hogel& h : setup.order.hogels()) {
            Plane& plane = pictures.emplace_back(setup.blank())[0];
            for (std::size_t y = 0; y < plane.height; ++y)
                for (std::size_t x = 0; x < plane.width; ++x) {
                    const double u = double(x) + disparity / 64 * double(h.s),
                                 v = double(y) + disparity / 64 * double(h.t);
                    plane.samples[y * plane.width + x] =
                        float(std::sin(0.5 * u + 0.3 * v) + std::cos(0.6 * v - 0.2 * u));
                }
        }
    }
    // Searches the block in the middle from one candidate.
    BlockSearch::Found search(int candidate, bool look = false, const KnownDisparities& known = {}) {
        const Plane& source = pictures.back()[0];
        WarpedBlocks warped(hogel, pictures);
        ReferenceWeights weights(hogel, setup.noise, setup.aspect);
        BlockSearch blocks(setup, hogel, source, warped, weights, known);
        BlockSamples target;
        for (std::size_t k = 0; k < block_samples; ++k)
            target[k] = source.samples[(8 + k / block_side) * source.width + 8 + k % block_side];
        Candidates candidates;
        candidates.add(candidate);
        const BlockSearch::Found& found = blocks.run(5, target, candidates);
        if (look) blocks.look_around();
        return found;
    }
};

// The search starts nearly one direction away from the right disparity.
TEST(BlockSearch, slopes_lead_to_the_disparity) {
    for (const int disparity : {-70, 0, 33})
        for (const int away : {-56, -20, 9, 48}) {
            Views views(disparity);
            const BlockSearch::Found found = views.search(disparity + away);
            EXPECT_GT(found.mode, 0);
            EXPECT_NEAR(found.disparity, disparity, 5) << away;
            EXPECT_LT(found.error, 2e-3f) << away;
        }
}

// If most references show another surface, slopes mislead, and either look_around() or the disparity of a neighbouring
// block is needed. A right candidate is taken at once.
TEST(BlockSearch, looks_farther_only_if_necessary) {
    constexpr int disparity = 20, away = 26;
    Views views(disparity);
    for (std::size_t k = 0; k < views.pictures.size(); ++k) {
        const HogelOrder::Hogel& shown = views.setup.order.hogels()[k];
        if (shown.s + 1 == views.hogel.s || &shown == &views.hogel) continue;
        std::uint32_t state = 1;
        for (float& sample : views.pictures[k][0].samples)
            sample = static_cast<float>((state = state * 1664525 + 1013904223) >> 8) * 0x1p-22f;
    }
    EXPECT_GT(std::abs(views.search(disparity - away).disparity - disparity), 12);
    const BlockSearch::Found found = views.search(disparity - away, true);
    EXPECT_NEAR(found.disparity, disparity, 5);
    EXPECT_EQ(found.mode, 1 + static_cast<int>(ReferenceWeights::Side::left));
    std::vector<Block> context(views.setup.grid.count());
    EXPECT_GT(std::abs(views.search(disparity - away, false, {{}, {}, &context}).disparity - disparity), 12);
    context[6].mode = mode_partitioned;
    context[6].second_disparity = disparity;
    EXPECT_NEAR(views.search(disparity - away, false, {{}, {}, &context}).disparity, disparity, 5);
    context[6].second_disparity = disparity + 12;
    EXPECT_EQ(views.search(disparity, false, {{}, {}, &context}).disparity, disparity);
}

}  // namespace
}  // namespace hogel::codec::encode
