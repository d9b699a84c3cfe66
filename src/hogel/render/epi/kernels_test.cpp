// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "hogel/array.h"
#include "hogel/render/epi/cut.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/test_plane.h"
#include "hogel/render/test_triangles.h"

namespace hogel::render::epi {
namespace {

using Draw = void (*)(std::span<const Strip>, std::size_t, const EpipolarPlane&);

// Coordinates of all kinds: on samples, between them, on both sides of the hologram and in it, near and far.
class Places {
  public:
    explicit Places(unsigned seed) : random_(seed) {}

    float whole_or_half(int most) { return 0.5f * float(int(random_() % unsigned(4 * most + 1)) - 2 * most); }
    float uniform(float most) { return std::uniform_real_distribution<float>(-most, most)(random_); }
    float x() { return random_() % 3 == 0 ? whole_or_half(20) : uniform(25); }
    float z() {
        switch (random_() % 6) {
            case 0:
                return 0;
            case 1:
                return whole_or_half(3);
            case 2:
                return uniform(1e-4f);
            case 3:
                return uniform(0.2f);
            default:
                return uniform(4);
        }
    }
    std::size_t between(std::size_t low, std::size_t high) { return low + random_() % (high - low + 1); }
    bool coin() { return random_() % 2 == 0; }

  private:
    std::mt19937 random_;
};

// The vector kernels as built for each instruction set that this processor has.
class EveryTarget : public KernelTargetTest {};
INSTANTIATE_TEST_SUITE_P(EpipolarKernels, EveryTarget, ::testing::ValuesIn(kernel_targets()));

TEST(EpipolarKernels, ordered_bits_are_in_the_order_of_the_floats) {
    const float infinity = std::numeric_limits<float>::infinity();
    const float values[] = {-infinity, -1e30f, -2, -1, -1e-30f, 0, 1e-30f, 1, 1.0000001f, 1e30f, infinity};
    for (std::size_t i = 1; i < std::size(values); ++i) EXPECT_LT(ordered_bits(values[i - 1]), ordered_bits(values[i]));
}

TEST_P(EveryTarget, vector_and_plain_drawings_are_the_same) {
    Places places(2);
    std::size_t covered = 0;
    for (int round = 0; round < 1500; ++round) {
        std::vector<Strip> strips(places.between(0, 12));
        for (Strip& strip : strips) {
            strip = {places.x(), places.z(), places.x(), places.z()};
            // Half of them small, as in a fine mesh.
            if (places.coin()) {
                strip.x1 = strip.x0 + places.uniform(0.5f);
                strip.z1 = strip.z0 + places.uniform(0.05f);
            }
        }
        const std::size_t columns = places.between(1, 45), directions = places.between(1, 80);
        const auto first = static_cast<std::int32_t>(places.between(0, 40)) - 30;
        TestPlane fast(columns, directions, first), plain(columns, directions, first);
        fast.plane.fronts_only = plain.plane.fronts_only = round % 3 == 0;
        draw(strips, 3, fast.plane);
        draw_plain(strips, 3, plain.plane);
        ASSERT_EQ(fast.words, plain.words) << round;  // what is to spare too
        for (std::uint64_t word : plain.words) covered += word != EpipolarPlane::nothing ? 1 : 0;
    }
    EXPECT_GT(covered, 50000u);
}

// Close to the hologram a column sees a strip in many directions: in more than are kept at once, of one vector of
// columns. And many thin strips at once, some of which are seen by nobody.
TEST_P(EveryTarget, what_is_found_in_parts_is_the_same_as_drawn_at_once) {
    Places places(9);
    std::size_t covered = 0, in_a_column = 0;
    for (int round = 0; round < 40; ++round) {
        const bool wide = round % 2 == 0;
        const std::size_t columns = places.between(1, 40), directions = wide ? places.between(1500, 2500) : 70;
        const auto first = static_cast<std::int32_t>(places.between(0, 40)) - 30;
        TestPlane fast(columns, directions, first), plain(columns, directions, first);
        fast.plane.fronts_only = plain.plane.fronts_only = round % 3 == 0;
        std::vector<Strip> strips(wide ? places.between(1, 4) : 1500);
        for (Strip& strip : strips) {
            const float x = float(first) + 0.5f * float(columns) + places.uniform(0.6f * float(columns));
            const float z = (places.coin() ? 1.0f : -1.0f) * (wide ? 4e-3f + std::abs(places.uniform(6e-3f)) : 0.3f);
            strip = {x, z, x + places.uniform(wide ? 0.9f : 0.1f), z + places.uniform(wide ? 1e-4f : 1e-2f)};
        }
        draw(strips, 3, fast.plane);
        draw_plain(strips, 3, plain.plane);
        ASSERT_EQ(fast.words, plain.words) << round;
        for (std::size_t column = 0; column < columns; ++column) {
            const std::uint64_t* words = &plain.words[column * directions];
            const auto nothing = std::count(words, words + directions, EpipolarPlane::nothing);
            const std::size_t seen = directions - static_cast<std::size_t>(nothing);
            covered += seen;
            if (wide) in_a_column = std::max(in_a_column, seen);
        }
    }
    EXPECT_GT(covered, 30000u);
    EXPECT_GT(in_a_column, 100u);
}

// Strips in layers one behind the other and across each other, as wide as cells and wider: what is passed over because
// of what was drawn before is what cannot be seen.
TEST_P(EveryTarget, what_is_drawn_over_what_is_known_is_the_same_as_drawn_at_once) {
    Places places(7);
    std::size_t hidden = 0;
    for (int round = 0; round < 150; ++round) {
        const std::size_t columns = places.between(1, 60), directions = places.between(1, 120);
        const auto first = static_cast<std::int32_t>(places.between(0, 40)) - 30;
        TestPlane fast(columns, directions, first), plain(columns, directions, first);
        fast.plane.fronts_only = plain.plane.fronts_only = round % 3 == 0;
        std::size_t number = 1;
        for (int layer = 0; layer < 8; ++layer) {
            std::vector<Strip> strips(places.between(0, 6));
            for (Strip& strip : strips) {
                // Several in the same depth, also that of the hologram.
                const float z = places.coin() ? 0.25f * float(layer - 3) : places.uniform(2);
                const float x = places.uniform(90);
                strip = {x, z, x + places.uniform(60), places.coin() ? z : z + places.uniform(0.3f)};
            }
            draw(strips, number, fast.plane);
            draw_plain(strips, number, plain.plane);
            ASSERT_EQ(fast.words, plain.words) << round << " " << layer;
            number += strips.size();
            find_farthest(fast.plane);
            for (std::size_t i = 0; i < columns * PlaneCells::rows(directions); ++i)
                hidden += fast.cells.farthest[i] < ordered_bits(1) ? 1 : 0;
        }
    }
    EXPECT_GT(hidden, 10000u);
}

// A strip whose ends change places turns its back to those who saw its front: each sees the one or the other.
TEST(EpipolarKernels, front_and_back_share_out_what_a_strip_covers) {
    Places places(8);
    std::size_t fronts = 0, backs = 0;
    for (int round = 0; round < 400; ++round) {
        const Strip strip{places.x(), places.z(), places.x(), places.z()},
            turned{strip.x1, strip.z1, strip.x0, strip.z0};
        const auto drawn = [&](const Strip& of, bool fronts_only) {
            TestPlane test(30, 40, -15);
            test.plane.fronts_only = fronts_only;
            draw_plain({&of, 1}, 1, test.plane);
            return test.words;
        };
        const auto both = drawn(strip, false), front = drawn(strip, true), back = drawn(turned, true);
        for (std::size_t i = 0; i < both.size(); ++i) {
            const bool in_front = front[i] != EpipolarPlane::nothing, in_back = back[i] != EpipolarPlane::nothing;
            ASSERT_EQ(both[i] != EpipolarPlane::nothing, in_front != in_back) << round;
            ASSERT_FALSE(in_front && in_back);
            fronts += in_front ? 1 : 0;
            backs += in_back ? 1 : 0;
        }
    }
    EXPECT_GT(fronts, 1000u);
    EXPECT_GT(backs, 1000u);
}

TEST(EpipolarKernels, triangles_that_share_an_edge_are_cut_in_the_same_point) {
    Places places(6);
    using Three = std::array<double, 3>;
    for (int round = 0; round < 10000; ++round) {
        const auto height = [&] { return std::abs(places.uniform(1)) * (places.coin() ? 1.0 : 1e-12); };
        const auto random3 = [&] { return Three{places.uniform(30) / 3.0, places.uniform(3) / 7.0, 0}; };
        // An edge across the plane, and corners that make it two triangles, each listed from any corner on.
        Three low = random3(), high = random3(), left = random3(), right = random3();
        low[2] = -1e-15 - height();
        high[2] = height();
        left[2] = places.coin() ? height() : -1e-15 - height();
        right[2] = places.coin() ? height() : -1e-15 - height();
        std::vector<Cut> shared;
        for (const auto& corners : {std::array{low, high, left}, std::array{high, low, right}}) {
            const std::size_t turn = places.between(0, 2);
            Three x, z, h;
            for (std::size_t i = 0; i < 3; ++i) {
                x[(i + turn) % 3] = corners[i][0];
                z[(i + turn) % 3] = corners[i][1];
                h[(i + turn) % 3] = corners[i][2];
            }
            const TriangleCut cut = cut_triangle(x, z, h);
            ASSERT_EQ(std::set({cut.lone, cut.next, cut.last}), (std::set<std::uint32_t>{0, 1, 2}));
            ASSERT_EQ(h[cut.next] < 0, h[cut.last] < 0);
            ASSERT_NE(h[cut.lone] < 0, h[cut.last] < 0);
            for (const auto& [end, other] : {std::pair{cut.end0, cut.next}, std::pair{cut.end1, cut.last}}) {
                const double w = end.weight;
                ASSERT_NEAR(w * h[cut.lone] + (1 - w) * h[other], 0, 1e-15);
                ASSERT_NEAR(w * x[cut.lone] + (1 - w) * x[other], end.x, 1e-13);
                ASSERT_NEAR(w * z[cut.lone] + (1 - w) * z[other], end.z, 1e-13);
                const std::size_t a = (cut.lone + 3 - turn) % 3, b = (other + 3 - turn) % 3;
                if (a + b == 1) shared.push_back(end);  // corners 0 and 1 are the edge
            }
        }
        ASSERT_EQ(shared.size(), 2u);
        ASSERT_EQ(shared[0].x, shared[1].x);
        ASSERT_EQ(shared[0].z, shared[1].z);
    }
}

class EveryDraw : public ::testing::TestWithParam<Draw> {};
INSTANTIATE_TEST_SUITE_P(EpipolarKernels, EveryDraw, ::testing::Values(&draw, &draw_plain),
                         [](const auto& parameter) { return parameter.param == &draw ? "vector" : "plain"; });

// Points whose lines of sight never overtake each other, from beyond the left of the plane to beyond its right: the
// strips between them share out the samples.
TEST_P(EveryDraw, gives_every_sample_to_one_strip_of_a_chain) {
    Places places(3);
    for (int round = 0; round < 60; ++round) {
        TestPlane counted(30, 41, -11);
        const float K_most = 20, slack = 1.01f;
        // A third of the chains lie on the samples themselves.
        const bool on_samples = round % 3 == 0;
        const float depth = on_samples ? places.whole_or_half(3) : places.uniform(3);
        std::vector<Strip> chain{{-500, depth, -200, depth}};
        while (chain.back().x1 < 200) {
            const float x = chain.back().x1, z = chain.back().z1;
            const float step = x < -100 || x > 100           ? 25
                               : on_samples || places.coin() ? 0.5f
                                                             : 0.01f + std::abs(places.uniform(1));
            const float dz = on_samples || places.coin() ? 0.0f : places.uniform(step / (slack * K_most));
            chain.push_back({x, z, x + step, z + dz});
        }
        std::vector<int> owners(30 * 41);
        for (const Strip& strip : chain) {
            std::fill(counted.words.begin(), counted.words.end(), EpipolarPlane::nothing);
            // Either end may come first.
            const Strip drawn = places.coin() ? strip : Strip{strip.x1, strip.z1, strip.x0, strip.z0};
            GetParam()({&drawn, 1}, 7, counted.plane);
            for (std::size_t i = 0; i < owners.size(); ++i)
                owners[i] += counted.words[i] != EpipolarPlane::nothing ? 1 : 0;
        }
        for (std::size_t i = 0; i < owners.size(); ++i) ASSERT_EQ(owners[i], 1) << round << " " << i;
    }
}

TEST_P(EveryDraw, puts_the_depth_where_the_line_of_sight_meets_the_segment) {
    Places places(4);
    std::size_t covered = 0;
    for (int round = 0; round < 300; ++round) {
        TestPlane seen(20, 31, -9);
        const Strip strip{places.x(), places.z(), places.x(), places.z()};
        GetParam()({&strip, 1}, 7, seen.plane);
        for (std::size_t i = 0; i < 20 * 31; ++i) {
            const double n = -9 + double(i / 31), K = double(i % 31) - 15;
            // x = n + K z along the ray, so the segment is met where x − n − K z changes its sign.
            const double a = strip.x0 - n - K * strip.z0, b = strip.x1 - n - K * strip.z1;
            if (std::abs(a) < 1e-3 || std::abs(b) < 1e-3) continue;
            ASSERT_EQ(seen.words[i] != EpipolarPlane::nothing, (a < 0) != (b < 0)) << round;
            if (seen.words[i] == EpipolarPlane::nothing) continue;
            ++covered;
            const double z = strip.z0 + a / (a - b) * (strip.z1 - strip.z0);
            ASSERT_EQ(seen.words[i] & 0xffffffff, 7u);
            const auto bits = static_cast<std::uint32_t>(seen.words[i] >> 32);
            EXPECT_GE(bits, ordered_bits(float(z - 2e-3)));
            EXPECT_LE(bits, ordered_bits(float(z + 2e-3)));
        }
    }
    EXPECT_GT(covered, 10000u);
}

TEST_P(EveryTarget, vector_and_plain_shadings_are_the_same) {
    Places places(5);
    std::vector<StripShades> strips(20);
    for (StripShades& strip : strips) {
        strip = {places.x(), places.z(), places.x(), places.z(), {}, {}};
        for (int i = 0; i < 4; ++i) {
            strip.value0[i] = places.uniform(1);
            strip.difference[i] = places.uniform(1);
        }
    }
    strips[EpipolarPlane::nobody] = {0, 0, 1, 0, {10, 20, 30, 40}, {}};
    strips[7] = {3, 1, 0, 0, {1, 2, 3, 4}, {5, 6, 7, 8}};  // a point
    for (std::size_t directions = 1; directions < 150; directions = directions < 40 ? directions + 1 : directions + 8) {
        const std::size_t columns = 3, size = columns * directions;
        // Few strips are taken for large ones.
        const std::size_t count = directions % 7 < 2 ? 3 : strips.size();
        const std::span some(strips.data(), count);
        TestPlane plane(columns, directions, -3);
        for (std::uint64_t& word : plane.words)
            if (places.coin()) word = std::uint64_t{12345} << 32 | places.between(0, static_cast<int>(count) - 1);
        // Runs of one strip, as large triangles make them: one to three in a vector, or a few more.
        const std::size_t run = directions % 2 == 0 ? 37 : directions % 3 == 0 ? 7 : 4;
        for (std::size_t k = 0; k < size; ++k)
            if (k / run % 2 == 0 || (directions % 4 == 1 && k % 50 < 40))
                plane.words[k] = std::uint64_t{k} << 32 | (k / run + directions) % count;
        // A column that sees nothing.
        if (directions % 3 == 0) std::fill_n(plane.words.begin(), directions, EpipolarPlane::nothing);
        // On cache lines, and off them.
        for (const std::size_t offset : {0, 1}) {
            using Row = std::vector<float, CacheLineAllocator<float>>;
            std::vector<Row> fast(4, Row(size + 2, -1)), plain = fast;
            const auto out = [&](std::vector<Row>& rows) {
                return ShadedPlane{{&rows[0][offset], &rows[1][offset], &rows[2][offset], &rows[3][offset]},
                                   {directions, directions, directions, directions}};
            };
            const std::vector<std::uint64_t> words = plane.words;
            std::vector<std::uint64_t> emptied = words;
            std::fill_n(emptied.begin(), size, EpipolarPlane::nothing);
            shade_scene(plane.plane, some, out(fast));
            ASSERT_EQ(plane.words, emptied) << directions;
            std::ranges::copy(words, plane.words.begin());
            shade_plain(plane.plane, some, out(plain));
            ASSERT_EQ(plane.words, emptied) << directions;
            std::ranges::copy(words, plane.words.begin());
            ASSERT_EQ(fast, plain) << directions;
            for (std::size_t i = 0; i < 4; ++i) {
                if (i == 1 && directions % 5 == 0) continue;
                EXPECT_EQ(plain[i][size + 1], -1);
                for (std::size_t k = 0; k < size; ++k) {
                    const float value = plain[i][k + offset];
                    const StripShades& strip = strips[plane.words[k] & 0xffffffff];
                    const float end = strip.value0[i] + strip.difference[i];
                    EXPECT_GE(value, std::min(strip.value0[i], end) - 1e-6f);
                    EXPECT_LE(value, std::max(strip.value0[i], end) + 1e-6f);
                }
            }
        }
    }
}

}  // namespace
}  // namespace hogel::render::epi
