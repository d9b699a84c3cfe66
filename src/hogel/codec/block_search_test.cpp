#include "hogel/codec/block_search_internal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hogel {
namespace {

// Three by three hogels that see a texture `disparity` 64ths of a direction away from each other; all but the last have
// been coded, and that one is searched for.
struct Views {
    TileSetup setup{HogelOrder(3, 3, 3, 1), 32, 32, 1, 0.003f, 1.35f, 1, true};
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
    // Of the block in the middle, from one candidate.
    BlockSearch::Found search(int candidate, Effort effort) {
        const Plane source = pictures.back()[0];
        BlockSearch blocks(setup, hogel, source, pictures, {}, effort);
        BlockSamples wanted;
        for (std::size_t k = 0; k < block_samples; ++k)
            wanted[k] = source.samples[(8 + k / block_side) * source.width + 8 + k % block_side];
        Candidates candidates;
        candidates.add(candidate);
        return blocks.run(5, wanted, candidates);
    }
};

// The slopes alone lead to the right disparity from nearly a direction away.
TEST(BlockSearch, follows_slopes_to_the_disparity) {
    for (const int disparity : {-70, 0, 33})
        for (const int away : {-56, -20, 9, 48}) {
            Views views(disparity);
            const BlockSearch::Found found = views.search(disparity + away, Effort::glance);
            EXPECT_GT(found.mode, 0);
            EXPECT_NEAR(found.disparity, disparity, 5) << away;
            EXPECT_LT(found.error, 2e-3f) << away;
        }
}

// What no slope leads to is found by looking around; a candidate that is right is taken as it is.
TEST(BlockSearch, looks_around_only_where_it_must) {
    Views views(20);
    EXPECT_NEAR(views.search(20 - 150, Effort::full).disparity, 20, 5);
    const BlockSearch::Found right = views.search(20, Effort::full);
    EXPECT_EQ(right.disparity, 20);
    EXPECT_EQ(right.mode, 1);
}

}  // namespace
}  // namespace hogel
