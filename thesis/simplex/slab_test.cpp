// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/slab.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/render/test_renderers.h"
#include "hogel/units.h"

namespace hogel::simplex {

using namespace render;

namespace {

using namespace literals;

HOGEL_TEST_ON_EVERY_TARGET(SlabKernels);

// Returns the front, with off-centre directions, and all sides of a hemicube, two of which have transposed axes.
std::vector<LightFieldGrid> grids() {
    LightFieldGrid aside{11, 9, 0.4_mm, 37, 5, Perspective{0.5, 0.4}, 3};
    aside.range().center_u = 0.2;
    std::vector<LightFieldGrid> all = hemicube({9, 11, 0.4_mm, 18, 20, Perspective{1, 1}, 3});
    all.push_back(aside);
    return all;
}

std::array<double, 3> three(std::mt19937& random, double middle, double size) {
    std::uniform_real_distribution<double> place(middle - size, middle + size);
    return {place(random), place(random), place(random)};
}

// Blocks of triangles of all sizes near some rows, some with corners on them, the last block not full.
TriangleBlocks random_blocks(std::mt19937& random) {
    TriangleBlocks blocks(6);
    std::uniform_real_distribution<double> middle(-30, 50);
    std::uint32_t index = 0;
    for (TriangleBlock& block : blocks)
        for (std::size_t i = 0; i < (&block == &blocks.back() ? 21 : TriangleBlock::size); ++i) {
            auto rows = three(random, middle(random), i % 4 == 0 ? 8 : 0.6);
            if (i % 5 == 0) rows[i % 3] = std::round(rows[i % 3]);
            block.set(i, index++, rows, three(random, 0, i % 3 == 0 ? 40 : 2));
        }
    return blocks;
}

TEST_P(SlabKernels, twins_find_the_same_triangles) {
    std::mt19937 random(3);
    std::size_t count = 0;
    for (const TriangleBlock& block : random_blocks(random))
        for (const float slope : {0.0f, 0.3f, -0.7f, 12.0f})
            for (const float last : {0.0f, 20.0f}) {
                std::array<std::uint32_t, TriangleBlock::size> fast{}, plain{};
                const SlabRows rows{slope, last};
                const std::size_t found = find_in_rows_plain(block, rows, plain.data());
                ASSERT_EQ(find_in_rows(block, rows, fast.data()), found);
                ASSERT_TRUE(std::equal(plain.begin(), plain.begin() + std::ptrdiff_t(found), fast.begin()));
                EXPECT_TRUE(found == 0 || rows.may_show(block));
                count += found;
            }
    EXPECT_GT(count, 200u);
}

// Compared with exact rows: finds all triangles that cover a row, and very few others.
TEST(Slab, finds_the_triangles_that_cover_rows_and_few_others) {
    std::mt19937 random(4);
    std::size_t covering = 0, all = 0;
    for (int round = 0; round < 40; ++round) {
        TriangleBlock block;
        std::array<std::array<double, 3>, TriangleBlock::size> rows, depths;
        for (std::uint32_t i = 0; i < TriangleBlock::size; ++i) {
            rows[i] = three(random, 10, 0.4 + i % 7);
            depths[i] = three(random, 30, 5);
            block.set(i, i, rows[i], depths[i]);
        }
        const SlabRows slab{0.02f * float(round - 20), 12};
        std::array<std::uint32_t, TriangleBlock::size> found{};
        const std::size_t count = find_in_rows_plain(block, slab, found.data());
        all += count;
        for (std::uint32_t i = 0; i < TriangleBlock::size; ++i) {
            double low = 1e9, high = -1e9;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const double row = rows[i][corner] - double{slab.slope} * depths[i][corner];
                low = std::min(low, row);
                high = std::max(high, row);
            }
            if (samples_between(low, high, 13).size() == 0) continue;
            ++covering;
            ASSERT_EQ(std::count(found.begin(), found.begin() + std::ptrdiff_t(count), i), 1) << round << " " << i;
        }
    }
    EXPECT_GT(covering, 300u);
    EXPECT_LE(all, covering + covering / 100);
}

// Triangles that a row cuts anywhere between two corners, wider or narrower than the distance of samples. Some have
// corners exactly on rays; some lines of their bands are longer than the field of view.
struct Drawn {
    ShadedScene scene;
    std::vector<Band> bands;
};

Drawn random_bands(std::mt19937& random, const LightFieldGrid& grid, const HogelRange& range, const SlabRays& rays) {
    std::uniform_real_distribution<double> part(0, 1), depth(-4e-3, 9e-3), step(-1, 1);
    Drawn drawn;
    const bool transposed = rays.axes().transposed();
    for (std::uint32_t i = 0; i < 60; ++i) {
        Band band;
        band.triangle = i;
        band.row = random() % rays.rows();
        band.columns = {random() % rays.directions(), rays.directions()};
        const double size = i % 3 == 0 ? 3e-3 : 0.2e-3, across = rays.slow_hogel(band.row);
        const double along = rays.fast_hogel(random() % rays.hogels()), far = depth(random);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const double zeta = far + (i % 7 == 0 ? 0 : size * step(random));
            // Every fourth triangle has a corner exactly on a ray of one direction.
            const bool on_ray = i % 4 == 0 && corner == 0;
            const std::size_t k = rays.directions() / 2;
            const double fast = along + rays.slopes()[k] * zeta + (on_ray ? 0 : size * step(random));
            const double slow = across + rays.slow_slope() * zeta + (on_ray ? 0 : size * step(random));
            const Vec3 p{transposed ? slow : fast, transposed ? fast : slow, -zeta};
            add_vertex(drawn.scene, p);
            band.fast[corner] = fast;
            band.depth[corner] = zeta;
            band.slow[corner] = (slow - rays.slow_slope() * zeta) - across;
            if (band.count < 2 + i % 4)
                band.include({rays.axes().fast_sign() * (fast - rays.axes().fast_hogel(range, 0)) / grid.pitch,
                              zeta / grid.pitch});
        }
        drawn.scene.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, ShadedScene::no_texture, 0});
        drawn.bands.push_back(band);
    }
    return drawn;
}

TEST_P(SlabKernels, twins_draw_the_same) {
    std::mt19937 random(5);
    std::size_t seen = 0;
    for (int round = 0; round < 60; ++round)
        for (const LightFieldGrid& grid : grids()) {
            const std::size_t fast_hogels = 1 + random() % 8;
            const HogelRange range{1, 2, fast_hogels, 3};
            const std::size_t slow = random() % RowAxes(grid).slow_directions();
            const Drawn drawn = random_bands(random, grid, range, SlabRays({}, false, grid, range, slow));
            const SlabTriangles triangles = slab_triangles(drawn.scene);
            const SlabRays rays(triangles, round % 3 == 0, grid, range, slow);
            const std::size_t count = rays.word(rays.rows(), 0, 0);
            std::vector<std::uint64_t> fast(count, nothing_seen()), plain = fast;
            Visits of_fast, of_plain;
            draw_bands(drawn.bands, rays, fast.data(), of_fast);
            draw_bands_plain(drawn.bands, rays, plain.data(), of_plain);
            ASSERT_EQ(fast, plain) << round;
            EXPECT_EQ(of_fast, of_plain);
            seen += count - std::size_t(std::ranges::count(plain, nothing_seen()));
        }
    EXPECT_GT(seen, 20000u);
}

// Depths of both signs and zeros in any order: the smallest wins, and of equal ones the first triangle.
TEST(Slab, words_order_samples_by_depth_and_triangle) {
    EXPECT_LT(seen_word(-1, 9), seen_word(-0.5f, 2));
    EXPECT_LT(seen_word(-0.5f, 9), seen_word(0, 2));
    EXPECT_EQ(seen_word(-0.0f, 2), seen_word(0.0f, 2));
    EXPECT_LT(seen_word(1, 2), seen_word(1, 3));
    EXPECT_LT(seen_word(std::numeric_limits<float>::max(), 3), nothing_seen());
    EXPECT_EQ(triangle_of(seen_word(-3, 77)), 77u);
}

TEST(Slab, coordinates_of_hogels_are_exact) {
    for (const LightFieldGrid& grid : grids()) {
        const HogelRange range{3, 1, 5, 6};
        const SlabRays rays({}, false, grid, range, 2);
        for (std::size_t i = 0; i < rays.hogels(); ++i)
            EXPECT_EQ(rays.fast_hogel(i), (rays.first_fast() + rays.fast_sign() * double(i)) * rays.pitch());
    }
}

}  // namespace
}  // namespace hogel::simplex
