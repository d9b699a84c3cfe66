// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/hierarchical_z.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/render/epi/test_plane.h"

namespace hogel::render::epi {
namespace {

// Drawing anything inside an occluded box, with any number, changes nothing. Boxes are on both sides of the hologram,
// some of them as near as the drawn spans.
TEST(HierarchicalZ, occludes_only_what_cannot_be_seen) {
    std::mt19937 random(1);
    const auto uniform = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    std::size_t occluded = 0, visible = 0;
    for (int round = 0; round < 400; ++round) {
        TestPlane drawn(1 + random() % 40, 1 + random() % 90, std::int32_t(random() % 40) - 30);
        std::vector<EpiSpan> walls;
        for (int wall = 0; wall < 4; ++wall) {
            const float x = uniform(-120, 60), z = round % 2 == 0 ? 0.5f : uniform(-1, 1);
            walls.push_back({x, z, x + uniform(20, 150), round % 2 == 0 ? 0.5f : z + uniform(-0.2f, 0.2f)});
        }
        draw_spans(walls, 5, drawn.plane);
        HierarchicalZ depths;
        depths.update(drawn.plane);
        for (int trial = 0; trial < 50; ++trial) {
            const double x = uniform(-60, 60), z = trial % 5 == 0 ? 0.5 : uniform(-2, 3);
            const ClusterBox box{x, x + uniform(0, 9), 0, 0, z, z + uniform(0, 0.3f)};
            BoxFootprints footprints;
            footprints.begin_row({&box, 1}, drawn.plane, 0, 0);
            const bool occludes = depths.occludes(footprints, 0, drawn.plane);
            (occludes ? occluded : visible) += 1;
            if (!occludes) continue;
            const std::vector<std::uint64_t> before = drawn.words;
            std::vector<EpiSpan> inside;
            for (int i = 0; i < 10; ++i) {
                // Points at the corners of the box and anywhere inside it.
                const auto point = [&](double low, double high) {
                    return random() % 3 == 0   ? float(low)
                           : random() % 2 == 0 ? float(high)
                                               : uniform(float(low), float(high));
                };
                inside.push_back({point(box.x_low, box.x_high), point(box.z_low, box.z_high),
                                  point(box.x_low, box.x_high), point(box.z_low, box.z_high)});
            }
            draw_spans(inside, 0, drawn.plane);
            ASSERT_EQ(drawn.words, before) << round << " " << trial;
        }
    }
    EXPECT_GT(occluded, 1000u);
    EXPECT_GT(visible, 1000u);
}

HOGEL_TEST_ON_EVERY_TARGET(HierarchicalZKernels);

// Boxes in front of, on and behind the hologram, near and far to the side; various numbers of directions.
TEST_P(HierarchicalZKernels, vector_and_plain_twins_agree) {
    std::mt19937 random(3);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::size_t occluded = 0, visible = 0, wide = 0;
    for (int round = 0; round < 200; ++round) {
        TestPlane drawn(1 + random() % 60, 1 + random() % 400, std::int32_t(random() % 40) - 30);
        for (std::uint32_t& cell : drawn.cells.max_depth) cell = random() % 50 == 0 ? ~0u : random() % 2000;
        std::vector<ClusterBox> boxes(21);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const double x = uniform(-60, 60) * (i % 7 == 0 ? 1e9 : 1), z = uniform(-1, 1) * (i % 3 == 0 ? 1e-3 : 1);
            boxes[i] = {x, x + uniform(0, i % 5 == 0 ? 40 : 9), 0, 0, z, z + uniform(0, 0.1)};
        }
        const double shift = uniform(-3, 3), z0 = round % 2 == 0 ? 0 : uniform(-1, 1);
        const std::size_t needed = CellColumns::needed(drawn.plane.directions);
        BoxFootprints fast;
        fast.begin_row(boxes, drawn.plane, shift, z0);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            std::vector<CellColumns, CacheLineAllocator<CellColumns>> columns(needed);
            const FootprintBounds plain = find_footprint_plain(boxes[i], drawn.plane, shift, z0, columns.data());
            ASSERT_EQ(std::memcmp(fast[i].columns, columns.data(), needed * sizeof(CellColumns)), 0)
                << round << " " << i;
            ASSERT_EQ(fast[i].bounds.min_depth, plain.min_depth);
            ASSERT_EQ(fast[i].bounds.max_columns, plain.max_columns);
            wide += plain.max_columns > 16;
            // At random depths, so that about half of them are occluded.
            const BoxFootprint some{columns.data(), {std::uint32_t(1500 + random() % 1500), plain.max_columns}};
            const bool occludes = cells_occlude_plain(drawn.plane, some);
            (occludes ? occluded : visible) += 1;
            EXPECT_EQ(cells_occlude(drawn.plane, some), occludes) << round << " " << i;
        }
    }
    EXPECT_GT(occluded, 500u);
    EXPECT_GT(visible, 500u);
    EXPECT_GT(wide, 500u);
}

TEST(HierarchicalZ, an_empty_plane_occludes_nothing) {
    TestPlane drawn(8, 16, 0);
    HierarchicalZ depths;
    const ClusterBox far{0, 1, 0, 1, 1e6, 2e6};
    BoxFootprints footprints;
    footprints.begin_row({&far, 1}, drawn.plane, 0, 0);
    EXPECT_FALSE(depths.occludes(footprints, 0, drawn.plane));
    depths.update(drawn.plane);
    EXPECT_FALSE(depths.occludes(footprints, 0, drawn.plane));
}

TEST_P(HierarchicalZKernels, cells_hold_the_farthest_depth) {
    std::mt19937 random(2);
    for (std::size_t columns : {1, 3, 4, 5, 24})
        for (std::size_t directions = 1; directions < 70; ++directions) {
            TestPlane drawn(columns, directions, 0);
            for (std::uint64_t& word : drawn.words)
                if (random() % 200 != 0) word = std::uint64_t{random() % 1000} << 32 | random();
            find_max_depths_plain(drawn.plane);
            const std::vector<std::uint32_t> plain = drawn.cells.max_depth;
            drawn.cells.clear(columns, directions);
            find_max_depths(drawn.plane);
            ASSERT_EQ(drawn.cells.max_depth, plain) << columns << " " << directions;
            std::vector<std::uint32_t> expected((directions + 15) / 16 * columns);
            for (std::size_t i = 0; i < columns * directions; ++i) {
                std::uint32_t& cell = expected[i % directions / 16 * columns + i / directions];
                cell = std::max(cell, std::uint32_t(drawn.words[i] >> 32));
            }
            ASSERT_TRUE(std::equal(expected.begin(), expected.end(), plain.begin()));
        }
}

}  // namespace
}  // namespace hogel::render::epi
