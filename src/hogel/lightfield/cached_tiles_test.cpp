// SPDX-License-Identifier: Apache-2.0
#include "hogel/light_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::lightfield {
namespace {

const LightFieldGrid grid{20, 9, 1e-3, 3, 2, Perspective{0.2, 0.2}, 3};

// A light field with a different value for every sample, which counts the hogels that are read.
class Numbered final : public LightFieldSource {
  public:
    explicit Numbered(std::atomic<std::size_t>& asked) : asked_(asked) {}
    const LightFieldGrid& grid() const override { return hogel::lightfield::grid; }
    bool has_depth() const override { return true; }
    HogelRange preferred_tile() const override { return {0, 0, 20, 2}; }
    void read(LightFieldTile& tile) const override {
        asked_ += tile.range.hogels();
        if (fails) throw Error(ErrorCode::bad_input, "broken");
        const HogelRange& r = tile.range;
        for (std::size_t t = 0; t < r.nt; ++t)
            for (std::size_t s = 0; s < r.ns; ++s)
                for (std::size_t v = 0; v < 2; ++v)
                    for (std::size_t u = 0; u < 3; ++u) {
                        const auto ray = static_cast<float>((((t + r.t0) * 20 + s + r.s0) * 2 + v) * 3 + u);
                        for (std::size_t c = 0; c < 3; ++c)
                            tile.radiance(c, t, s, v, u) = 10000 * static_cast<float>(c) + ray;
                        if (tile.depth.size() > 0) tile.depth(t, s, v, u) = -ray;
                    }
    }

    mutable bool fails = false;

  private:
    std::atomic<std::size_t>& asked_;
};

constexpr double tile_bytes = 20 * 2 * 6 * 4 * sizeof(float);  // with depth

void expect_all_in_tiles(const LightFieldSource& source, std::size_t ns, std::size_t nt, bool with_depth) {
    std::atomic<std::size_t> asked = 0;
    const Numbered truth(asked);
    const std::size_t across = (20 + ns - 1) / ns, down = (9 + nt - 1) / nt;
    std::atomic<std::size_t> wrong = 0;
    work::parallel_for(across * down, [&](std::size_t i) {
        const std::size_t s0 = i % across * ns, t0 = i / across * nt;
        const HogelRange range{s0, t0, std::min(ns, 20 - s0), std::min(nt, 9 - t0)};
        LightFieldTile tile(grid, range, with_depth), expected(grid, range, with_depth);
        source.read(tile);
        truth.read(expected);
        wrong += std::ranges::equal(tile.radiance.elements(), expected.radiance.elements()) &&
                         std::ranges::equal(tile.depth.elements(), expected.depth.elements())
                     ? 0
                     : 1;
    });
    EXPECT_EQ(wrong, 0u) << ns << "x" << nt;
}

TEST(KeepTiles, gives_the_same_values_and_reads_each_hogel_once) {
    for (const bool with_depth : {false, true})
        for (const auto& [ns, nt] : {std::pair<std::size_t, std::size_t>{3, 4}, {7, 1}, {1, 9}, {20, 3}, {4, 2}}) {
            std::atomic<std::size_t> asked = 0;
            const auto kept = cached_tiles(std::make_unique<Numbered>(asked), 20 * tile_bytes, with_depth);
            expect_all_in_tiles(kept.front(), ns, nt, with_depth);
            EXPECT_EQ(asked, 180u) << ns << "x" << nt;
        }
}

TEST(KeepTiles, reads_from_the_source_where_nothing_fits_or_no_depth_is_kept) {
    std::atomic<std::size_t> asked = 0;
    expect_all_in_tiles(cached_tiles(std::make_unique<Numbered>(asked), 2.5 * tile_bytes, true).front(), 3, 4, true);
    EXPECT_EQ(asked, 180u);
    asked = 0;
    expect_all_in_tiles(cached_tiles(std::make_unique<Numbered>(asked), 20 * tile_bytes, false).front(), 3, 4, true);
    EXPECT_EQ(asked, 180u);
}

TEST(KeepTiles, forgets_what_failed) {
    std::atomic<std::size_t> asked = 0;
    auto source = std::make_unique<Numbered>(asked);
    const Numbered& numbered = *source;
    const auto kept = cached_tiles(std::move(source), 20 * tile_bytes);
    LightFieldTile tile(grid, {1, 1, 2, 2}, false);
    numbered.fails = true;
    EXPECT_THROW(kept.front().read(tile), Error);
    numbered.fails = false;
    expect_all_in_tiles(kept.front(), 3, 4, false);
}

// Wraps a light field and counts tiles in reused memory; new memory is zero.
class Used final : public LightFieldSource {
  public:
    explicit Used(std::size_t& used) : used_(used), inner_(asked_) {}
    const LightFieldGrid& grid() const override { return inner_.grid(); }
    bool has_depth() const override { return true; }
    HogelRange preferred_tile() const override { return inner_.preferred_tile(); }
    void read(LightFieldTile& tile) const override {
        used_ += std::ranges::any_of(tile.radiance.elements(), [](float value) { return value != 0; }) ? 1 : 0;
        inner_.read(tile);
    }

  private:
    std::size_t& used_;
    std::atomic<std::size_t> asked_ = 0;
    Numbered inner_;
};

TEST(KeepTiles, uses_the_memory_of_forgotten_tiles_again) {
    std::size_t used = 0;
    const auto kept = cached_tiles(std::make_unique<Used>(used), 2 * tile_bytes, true);
    std::atomic<std::size_t> asked = 0;
    const Numbered truth(asked);
    for (std::size_t t = 0; t < 9; ++t) {
        const HogelRange range{3, t, 5, 1};
        LightFieldTile tile(grid, range, true), expected(grid, range, true);
        kept.front().read(tile);
        truth.read(expected);
        EXPECT_TRUE(std::ranges::equal(tile.radiance.elements(), expected.radiance.elements())) << t;
        EXPECT_TRUE(std::ranges::equal(tile.depth.elements(), expected.depth.elements())) << t;
    }
    // Two of five tiles are kept: the third and the fourth take the place of the first ones. The fifth is of half the
    // height.
    EXPECT_EQ(used, 2u);
}

}  // namespace
}  // namespace hogel::lightfield
