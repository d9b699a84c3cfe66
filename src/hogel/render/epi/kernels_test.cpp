// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "hogel/array.h"
#include "hogel/core/test_targets.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/test_plane.h"
#include "hogel/render/epi/test_triangles.h"
#include "hogel/render/epi/triangle_cut.h"

namespace hogel::render::epi {
namespace {

using Draw = void (*)(std::span<const EpiSpan>, std::size_t, const EpipolarPlane&);

// Random coordinates of all kinds: on samples, between them, on both sides of the hologram and on it, near and far.
class Coordinates {
  public:
    explicit Coordinates(unsigned seed) : random_(seed) {}

    float whole_or_half(int max) { return 0.5f * float(int(random_() % unsigned(4 * max + 1)) - 2 * max); }
    float uniform(float max) { return std::uniform_real_distribution<float>(-max, max)(random_); }
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

HOGEL_TEST_ON_EVERY_TARGET(PlaneKernels);

TEST(EpipolarKernels, ordered_bits_compare_like_floats) {
    const float infinity = std::numeric_limits<float>::infinity();
    const float values[] = {-infinity, -1e30f, -2, -1, -1e-30f, 0, 1e-30f, 1, 1.0000001f, 1e30f, infinity};
    for (std::size_t i = 1; i < std::size(values); ++i) EXPECT_LT(ordered_bits(values[i - 1]), ordered_bits(values[i]));
}

TEST_P(PlaneKernels, vector_and_plain_twins_draw_the_same) {
    Coordinates random(2);
    std::size_t covered = 0;
    for (int round = 0; round < 1500; ++round) {
        std::vector<EpiSpan> spans(random.between(0, 12));
        for (EpiSpan& span : spans) {
            span = {random.x(), random.z(), random.x(), random.z()};
            // Half of them are small, as in a fine mesh.
            if (random.coin()) {
                span.x1 = span.x0 + random.uniform(0.5f);
                span.z1 = span.z0 + random.uniform(0.05f);
            }
        }
        const std::size_t columns = random.between(1, 45), directions = random.between(1, 80);
        const auto first = static_cast<std::int32_t>(random.between(0, 40)) - 30;
        TestPlane fast(columns, directions, first), plain(columns, directions, first);
        fast.plane.fronts_only = plain.plane.fronts_only = round % 3 == 0;
        draw_spans(spans, 3, fast.plane);
        draw_spans_plain(spans, 3, plain.plane);
        ASSERT_EQ(fast.words, plain.words) << round;  // including the padding
        for (std::uint64_t word : plain.words) covered += word != EpipolarPlane::empty ? 1 : 0;
    }
    EXPECT_GT(covered, 50000u);
}

// Rounds alternate between spans close to the hologram, for which the columns of one vector have more candidates than
// the queue holds, and many thin spans, some of them invisible.
TEST_P(PlaneKernels, full_queues_change_nothing) {
    Coordinates random(9);
    std::size_t covered = 0, in_a_column = 0;
    for (int round = 0; round < 40; ++round) {
        const bool wide = round % 2 == 0;
        const std::size_t columns = random.between(1, 40), directions = wide ? random.between(1500, 2500) : 70;
        const auto first = static_cast<std::int32_t>(random.between(0, 40)) - 30;
        TestPlane fast(columns, directions, first), plain(columns, directions, first);
        fast.plane.fronts_only = plain.plane.fronts_only = round % 3 == 0;
        std::vector<EpiSpan> spans(wide ? random.between(1, 4) : 1500);
        for (EpiSpan& span : spans) {
            const float x = float(first) + 0.5f * float(columns) + random.uniform(0.6f * float(columns));
            const float z = (random.coin() ? 1.0f : -1.0f) * (wide ? 4e-3f + std::abs(random.uniform(6e-3f)) : 0.3f);
            span = {x, z, x + random.uniform(wide ? 0.9f : 0.1f), z + random.uniform(wide ? 1e-4f : 1e-2f)};
        }
        draw_spans(spans, 3, fast.plane);
        draw_spans_plain(spans, 3, plain.plane);
        ASSERT_EQ(fast.words, plain.words) << round;
        for (std::size_t column = 0; column < columns; ++column) {
            const std::uint64_t* words = &plain.words[column * directions];
            const auto nothing = std::count(words, words + directions, EpipolarPlane::empty);
            const std::size_t seen = directions - static_cast<std::size_t>(nothing);
            covered += seen;
            if (wide) in_a_column = std::max(in_a_column, seen);
        }
    }
    EXPECT_GT(covered, 30000u);
    EXPECT_GT(in_a_column, 100u);
}

// Spans in layers, behind each other and intersecting, as wide as cells and wider.
TEST_P(PlaneKernels, hierarchical_z_changes_nothing) {
    Coordinates random(7);
    std::size_t occluded = 0;
    for (int round = 0; round < 150; ++round) {
        const std::size_t columns = random.between(1, 60), directions = random.between(1, 120);
        const auto first = static_cast<std::int32_t>(random.between(0, 40)) - 30;
        TestPlane fast(columns, directions, first), plain(columns, directions, first);
        fast.plane.fronts_only = plain.plane.fronts_only = round % 3 == 0;
        std::size_t number = 1;
        for (int layer = 0; layer < 8; ++layer) {
            std::vector<EpiSpan> spans(random.between(0, 6));
            for (EpiSpan& span : spans) {
                // Several have the same depth, some that of the hologram.
                const float z = random.coin() ? 0.25f * float(layer - 3) : random.uniform(2);
                const float x = random.uniform(90);
                span = {x, z, x + random.uniform(60), random.coin() ? z : z + random.uniform(0.3f)};
            }
            draw_spans(spans, number, fast.plane);
            draw_spans_plain(spans, number, plain.plane);
            ASSERT_EQ(fast.words, plain.words) << round << " " << layer;
            number += spans.size();
            find_max_depths(fast.plane);
            for (std::size_t i = 0; i < columns * DepthCells::rows(directions); ++i)
                occluded += fast.cells.max_depth[i] < ordered_bits(1) ? 1 : 0;
        }
    }
    EXPECT_GT(occluded, 10000u);
}

// A span with exchanged ends shows its back where it showed its front.
TEST(EpipolarKernels, front_and_back_share_the_samples_of_a_span) {
    Coordinates random(8);
    std::size_t fronts = 0, backs = 0;
    for (int round = 0; round < 400; ++round) {
        const EpiSpan span{random.x(), random.z(), random.x(), random.z()}, turned{span.x1, span.z1, span.x0, span.z0};
        const auto drawn = [&](const EpiSpan& of, bool fronts_only) {
            TestPlane test(30, 40, -15);
            test.plane.fronts_only = fronts_only;
            draw_spans_plain({&of, 1}, 1, test.plane);
            return test.words;
        };
        const auto both = drawn(span, false), front = drawn(span, true), back = drawn(turned, true);
        for (std::size_t i = 0; i < both.size(); ++i) {
            const bool in_front = front[i] != EpipolarPlane::empty, in_back = back[i] != EpipolarPlane::empty;
            ASSERT_EQ(both[i] != EpipolarPlane::empty, in_front != in_back) << round;
            ASSERT_FALSE(in_front && in_back);
            fronts += in_front ? 1 : 0;
            backs += in_back ? 1 : 0;
        }
    }
    EXPECT_GT(fronts, 1000u);
    EXPECT_GT(backs, 1000u);
}

TEST(EpipolarKernels, triangles_that_share_an_edge_share_its_crossing) {
    Coordinates random(6);
    using Three = std::array<double, 3>;
    for (int round = 0; round < 10000; ++round) {
        const auto height = [&] { return std::abs(random.uniform(1)) * (random.coin() ? 1.0 : 1e-12); };
        const auto random3 = [&] { return Three{random.uniform(30) / 3.0, random.uniform(3) / 7.0, 0}; };
        // An edge across the plane and two other corners form two triangles, each listed from a random corner on.
        Three low = random3(), high = random3(), left = random3(), right = random3();
        low[2] = -1e-15 - height();
        high[2] = height();
        left[2] = random.coin() ? height() : -1e-15 - height();
        right[2] = random.coin() ? height() : -1e-15 - height();
        std::vector<Crossing> shared;
        for (const auto& corners : {std::array{low, high, left}, std::array{high, low, right}}) {
            const std::size_t shift = random.between(0, 2);
            Three x, z, h;
            for (std::size_t i = 0; i < 3; ++i) {
                x[(i + shift) % 3] = corners[i][0];
                z[(i + shift) % 3] = corners[i][1];
                h[(i + shift) % 3] = corners[i][2];
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
                const std::size_t a = (cut.lone + 3 - shift) % 3, b = (other + 3 - shift) % 3;
                if (a + b == 1) shared.push_back(end);  // corners 0 and 1 are the edge
            }
        }
        ASSERT_EQ(shared.size(), 2u);
        ASSERT_EQ(shared[0].x, shared[1].x);
        ASSERT_EQ(shared[0].z, shared[1].z);
    }
}

class EveryTwin : public ::testing::TestWithParam<Draw> {};
INSTANTIATE_TEST_SUITE_P(EpipolarKernels, EveryTwin, ::testing::Values(&draw_spans, &draw_spans_plain),
                         [](const auto& parameter) { return parameter.param == &draw_spans ? "vector" : "plain"; });

// A chain of points from left to right, in all directions, so that no sample sees two of its spans.
TEST_P(EveryTwin, gives_every_sample_to_one_span_of_a_chain) {
    Coordinates random(3);
    for (int round = 0; round < 60; ++round) {
        TestPlane counted(30, 41, -11);
        const float max_K = 20, slack = 1.01f;
        // A third of the chains are exactly on samples.
        const bool on_samples = round % 3 == 0;
        const float depth = on_samples ? random.whole_or_half(3) : random.uniform(3);
        std::vector<EpiSpan> chain{{-500, depth, -200, depth}};
        while (chain.back().x1 < 200) {
            const float x = chain.back().x1, z = chain.back().z1;
            const float step = x < -100 || x > 100           ? 25
                               : on_samples || random.coin() ? 0.5f
                                                             : 0.01f + std::abs(random.uniform(1));
            const float dz = on_samples || random.coin() ? 0.0f : random.uniform(step / (slack * max_K));
            chain.push_back({x, z, x + step, z + dz});
        }
        std::vector<int> owners(30 * 41);
        for (const EpiSpan& span : chain) {
            std::fill(counted.words.begin(), counted.words.end(), EpipolarPlane::empty);
            // Either end may come first.
            const EpiSpan drawn = random.coin() ? span : EpiSpan{span.x1, span.z1, span.x0, span.z0};
            GetParam()({&drawn, 1}, 7, counted.plane);
            for (std::size_t i = 0; i < owners.size(); ++i)
                owners[i] += counted.words[i] != EpipolarPlane::empty ? 1 : 0;
        }
        for (std::size_t i = 0; i < owners.size(); ++i) ASSERT_EQ(owners[i], 1) << round << " " << i;
    }
}

TEST_P(EveryTwin, depth_is_where_the_ray_meets_the_segment) {
    Coordinates random(4);
    std::size_t covered = 0;
    for (int round = 0; round < 300; ++round) {
        TestPlane seen(20, 31, -9);
        const EpiSpan span{random.x(), random.z(), random.x(), random.z()};
        GetParam()({&span, 1}, 7, seen.plane);
        for (std::size_t i = 0; i < 20 * 31; ++i) {
            const double n = -9 + double(i / 31), K = double(i % 31) - 15;
            // x = n + K z along the ray, so the ray meets the segment where x − n − K z changes its sign.
            const double a = span.x0 - n - K * span.z0, b = span.x1 - n - K * span.z1;
            if (std::abs(a) < 1e-3 || std::abs(b) < 1e-3) continue;
            ASSERT_EQ(seen.words[i] != EpipolarPlane::empty, (a < 0) != (b < 0)) << round;
            if (seen.words[i] == EpipolarPlane::empty) continue;
            ++covered;
            const double z = span.z0 + a / (a - b) * (span.z1 - span.z0);
            ASSERT_EQ(seen.words[i] & 0xffffffff, 7u);
            const auto bits = static_cast<std::uint32_t>(seen.words[i] >> 32);
            EXPECT_GE(bits, ordered_bits(float(z - 2e-3)));
            EXPECT_LE(bits, ordered_bits(float(z + 2e-3)));
        }
    }
    EXPECT_GT(covered, 10000u);
}

std::vector<SpanValues> random_values(Coordinates& random) {
    std::vector<SpanValues> spans(20);
    for (SpanValues& span : spans) {
        span = {random.x(), random.z(), random.x(), random.z(), {}, {}};
        for (int i = 0; i < 4; ++i) {
            span.value0[i] = random.uniform(1);
            span.difference[i] = random.uniform(1);
        }
    }
    spans[EpipolarPlane::background] = {0, 0, 1, 0, {10, 20, 30, 40}, {}};
    spans[7] = {3, 1, 0, 0, {1, 2, 3, 4}, {5, 6, 7, 8}};  // a point
    return spans;
}

// Fills a plane with random spans, runs of one span and an empty column.
void see_spans(Coordinates& random, std::size_t count, TestPlane& test) {
    const std::size_t directions = test.plane.directions, size = test.plane.columns * directions;
    for (std::uint64_t& word : test.words)
        if (random.coin()) word = std::uint64_t{12345} << 32 | random.between(0, static_cast<int>(count) - 1);
    // Runs of samples as from large triangles: one to three per vector, or a few more.
    const std::size_t run = directions % 2 == 0 ? 37 : directions % 3 == 0 ? 7 : 4;
    for (std::size_t k = 0; k < size; ++k)
        if (k / run % 2 == 0 || (directions % 4 == 1 && k % 50 < 40))
            test.words[k] = std::uint64_t{k} << 32 | (k / run + directions) % count;
    if (directions % 3 == 0) std::fill_n(test.words.begin(), directions, EpipolarPlane::empty);
}

TEST_P(PlaneKernels, vector_and_plain_twins_shade_the_same) {
    Coordinates random(5);
    const std::vector<SpanValues> spans = random_values(random);
    for (std::size_t directions = 1; directions < 150; directions = directions < 40 ? directions + 1 : directions + 8) {
        const std::size_t columns = 3, size = columns * directions;
        // If there are few spans, the kernel expects large ones.
        const std::size_t count = directions % 7 < 2 ? 3 : spans.size();
        const std::span some(spans.data(), count);
        TestPlane plane(columns, directions, -3);
        see_spans(random, count, plane);
        // Aligned to cache lines, and not aligned.
        for (const std::size_t offset : {0, 1}) {
            using Row = std::vector<float, CacheLineAllocator<float>>;
            std::vector<Row> fast(4, Row(size + 2, -1)), plain = fast;
            const auto out = [&](std::vector<Row>& rows) {
                return PlaneOutput{{&rows[0][offset], &rows[1][offset], &rows[2][offset], &rows[3][offset]},
                                   {directions, directions, directions, directions}};
            };
            const std::vector<std::uint64_t> words = plane.words;
            std::vector<std::uint64_t> emptied = words;
            std::fill_n(emptied.begin(), size, EpipolarPlane::empty);
            shade_between_ends(plane.plane, some, out(fast));
            ASSERT_EQ(plane.words, emptied) << directions;
            std::ranges::copy(words, plane.words.begin());
            shade_between_ends_plain(plane.plane, some, out(plain));
            ASSERT_EQ(plane.words, emptied) << directions;
            std::ranges::copy(words, plane.words.begin());
            ASSERT_EQ(fast, plain) << directions;
            for (std::size_t i = 0; i < 4; ++i) {
                EXPECT_EQ(plain[i][size + 1], -1);
                for (std::size_t k = 0; k < size; ++k) {
                    const float value = plain[i][k + offset];
                    const SpanValues& span = spans[plane.words[k] & 0xffffffff];
                    const float end = span.value0[i] + span.difference[i];
                    EXPECT_GE(value, std::min(span.value0[i], end) - 1e-6f);
                    EXPECT_LE(value, std::max(span.value0[i], end) + 1e-6f);
                }
            }
        }
    }
}

}  // namespace
}  // namespace hogel::render::epi
