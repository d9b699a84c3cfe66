// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/occlusion.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "hogel/render/test_plane.h"

namespace hogel::render::epi {
namespace {

// Whatever lies in a box that is hidden changes nothing when it is drawn after all, with whatever number. Boxes are
// offered on both sides of the hologram, and some just as near as what is there.
TEST(Occlusion, hides_only_what_cannot_be_seen_and_hides_something) {
    std::mt19937 random(1);
    const auto uniform = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    std::size_t hidden = 0, visible = 0;
    for (int round = 0; round < 400; ++round) {
        TestPlane drawn(1 + random() % 40, 1 + random() % 90, std::int32_t(random() % 40) - 30);
        std::vector<Strip> walls;
        for (int wall = 0; wall < 4; ++wall) {
            const float x = uniform(-120, 60), z = round % 2 == 0 ? 0.5f : uniform(-1, 1);
            walls.push_back({x, z, x + uniform(20, 150), round % 2 == 0 ? 0.5f : z + uniform(-0.2f, 0.2f)});
        }
        draw(walls, 5, drawn.plane);
        Occlusion occlusion;
        occlusion.update(drawn.plane);
        for (int offer = 0; offer < 50; ++offer) {
            const double x = uniform(-60, 60), z = offer % 5 == 0 ? 0.5 : uniform(-2, 3);
            const ClusterBox box{x, x + uniform(0, 9), 0, 0, z, z + uniform(0, 0.3f)};
            SeenBoxes seen;
            seen.begin_row({&box, 1}, drawn.plane, 0, 0);
            const bool hides = occlusion.hides(seen, 0, drawn.plane);
            (hides ? hidden : visible) += 1;
            if (!hides) continue;
            const std::vector<std::uint64_t> before = drawn.words;
            std::vector<Strip> inside;
            for (int i = 0; i < 10; ++i) {
                // Through the corners of the box and anywhere in it.
                const auto point = [&](double low, double high) {
                    return random() % 3 == 0   ? float(low)
                           : random() % 2 == 0 ? float(high)
                                               : uniform(float(low), float(high));
                };
                inside.push_back({point(box.x_low, box.x_high), point(box.z_low, box.z_high),
                                  point(box.x_low, box.x_high), point(box.z_low, box.z_high)});
            }
            draw(inside, 0, drawn.plane);
            ASSERT_EQ(drawn.words, before) << round << " " << offer;
        }
    }
    EXPECT_GT(hidden, 1000u);
    EXPECT_GT(visible, 1000u);
}

// Boxes before, in and behind the hologram, near and far aside, in planes with and without whole lines of cells.
TEST(Occlusion, vector_and_plain_boxes_are_seen_and_hidden_alike) {
    std::mt19937 random(3);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::size_t hidden = 0, visible = 0, wide = 0;
    for (int round = 0; round < 200; ++round) {
        TestPlane drawn(1 + random() % 60, 1 + random() % 400, std::int32_t(random() % 40) - 30);
        for (std::uint32_t& cell : drawn.cells.farthest) cell = random() % 50 == 0 ? ~0u : random() % 2000;
        std::vector<ClusterBox> boxes(21);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const double x = uniform(-60, 60) * (i % 7 == 0 ? 1e9 : 1), z = uniform(-1, 1) * (i % 3 == 0 ? 1e-3 : 1);
            boxes[i] = {x, x + uniform(0, i % 5 == 0 ? 40 : 9), 0, 0, z, z + uniform(0, 0.1)};
        }
        const double shift = uniform(-3, 3), z0 = round % 2 == 0 ? 0 : uniform(-1, 1);
        const std::size_t lines = CellColumns::lines(drawn.plane.directions);
        SeenBoxes fast;
        for (const std::int64_t target : kernel_targets()) {
            use_kernel_target(target);
            fast.begin_row(boxes, drawn.plane, shift, z0);
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                std::vector<CellColumns, CacheLineAllocator<CellColumns>> columns(lines);
                const BoxDepth plain = see_box_plain(boxes[i], drawn.plane, shift, z0, columns.data());
                ASSERT_EQ(std::memcmp(fast[i].columns, columns.data(), lines * sizeof(CellColumns)), 0)
                    << target << " " << round << " " << i;
                ASSERT_EQ(fast[i].depth.nearest, plain.nearest);
                ASSERT_EQ(fast[i].depth.widest, plain.widest);
                wide += plain.widest > 16;
                // Of any depth, for what is hidden has one above all.
                const SeenBox some{columns.data(), {std::uint32_t(1500 + random() % 1500), plain.widest}};
                const bool hides = cells_hide_plain(drawn.plane, some);
                (hides ? hidden : visible) += 1;
                EXPECT_EQ(cells_hide(drawn.plane, some), hides) << target << " " << round << " " << i;
            }
            use_kernel_target(0);
        }
    }
    EXPECT_GT(hidden, 500u);
    EXPECT_GT(visible, 500u);
    EXPECT_GT(wide, 500u);
}

TEST(Occlusion, an_empty_plane_hides_nothing) {
    TestPlane drawn(8, 16, 0);
    Occlusion occlusion;
    const ClusterBox far{0, 1, 0, 1, 1e6, 2e6};
    SeenBoxes seen;
    seen.begin_row({&far, 1}, drawn.plane, 0, 0);
    EXPECT_FALSE(occlusion.hides(seen, 0, drawn.plane));
    occlusion.update(drawn.plane);
    EXPECT_FALSE(occlusion.hides(seen, 0, drawn.plane));
}

TEST(Occlusion, cells_hold_the_farthest_depth_in_all_kernels) {
    std::mt19937 random(2);
    for (std::size_t columns : {1, 3, 4, 5, 24})
        for (std::size_t directions = 1; directions < 70; ++directions) {
            TestPlane drawn(columns, directions, 0);
            for (std::uint64_t& word : drawn.words)
                if (random() % 200 != 0) word = std::uint64_t{random() % 1000} << 32 | random();
            find_farthest_plain(drawn.plane);
            const std::vector<std::uint32_t> plain = drawn.cells.farthest;
            for (const std::int64_t target : kernel_targets()) {
                drawn.cells.clear(columns, directions);
                use_kernel_target(target);
                find_farthest(drawn.plane);
                use_kernel_target(0);
                ASSERT_EQ(drawn.cells.farthest, plain) << target << " " << columns << " " << directions;
            }
            std::vector<std::uint32_t> most((directions + 15) / 16 * columns);
            for (std::size_t i = 0; i < columns * directions; ++i) {
                std::uint32_t& cell = most[i % directions / 16 * columns + i / directions];
                cell = std::max(cell, std::uint32_t(drawn.words[i] >> 32));
            }
            ASSERT_TRUE(std::equal(most.begin(), most.end(), plain.begin()));
        }
}

}  // namespace
}  // namespace hogel::render::epi
