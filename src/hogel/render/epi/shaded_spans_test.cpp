// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/shaded_spans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "hogel/core/test_targets.h"
#include "hogel/render/epi/test_triangles.h"
#include "hogel/render/sample_store.h"

namespace hogel::render::epi {
namespace {

using Weights = std::array<float, 3>;

// Light that is linear on each triangle, or a wave; partly negative, unlike real light.
class TestLight final : public SampleLighting {
  public:
    explicit TestLight(bool linear) : linear_(linear) {}
    Size size_of_light(std::size_t) const override { return {3, 0}; }
    bool light_is_radiance(std::size_t) const override { return true; }
    void light_on(const ShadedScene&, std::size_t index, const Weights& w, std::span<float> light) const override {
        for (std::size_t i = 0; i < 3; ++i)
            light[i] = linear_ ? 3 + float(i) * w[0] - 2 * w[1] + 0.3f * float(index)
                               : std::sin(float(index + i) + 9 * w[0] + 14 * w[1] * w[2]) + 0.7f * float(i);
    }

  private:
    bool linear_;
};

// A large triangle, slivers and small ones, listed from different corners on.
ShadedScene lit_triangles(float spacing, bool linear) {
    ShadedScene scene;
    scene.positions = {{-1, -1, 0}, {1, -0.9, 0.2}, {0.1, 1, -0.3}, {-0.99, -1, 0}, {0.1, 1.01, -0.3}, {-1, -0.98, 0}};
    for (const std::array<std::uint32_t, 3>& corners :
         {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 3, 2}, {2, 0, 3}, {1, 2, 4}, {3, 0, 5}, {2, 0, 1}})
        scene.triangles.push_back({corners, ShadedScene::no_texture, 0});
    scene.radiance.resize(scene.positions.size());
    scene.texture_coordinates.resize(scene.positions.size());
    scene.lighting = std::make_shared<TestLight>(linear);
    shading::add_radiance_cache(scene, std::vector<float>(scene.triangles.size(), spacing));
    return scene;
}

// Spans of one plane: number 0 is the background, others are anywhere on triangles.
struct TestSpans final : RadianceSource {
    const ShadedScene& scene;
    std::vector<SpanValues> values;
    std::vector<RadianceFrom> from;
    std::vector<SpanOrigin> origins;
    mutable std::size_t points_filled = 0;

    TestSpans(const ShadedScene& lit, std::mt19937& random, std::size_t count) : scene(lit) {
        std::uniform_real_distribution<float> fraction(0, 1), coordinate(-25, 25);
        const auto on_side = [&] { return random() % 5 == 0 ? 0.0f : fraction(random); };  // sometimes a corner
        origins.emplace_back();
        values.push_back({0, 0, 1, 0, {10, 20, 30, std::numeric_limits<float>::infinity()}, {}});
        from.push_back(RadianceFrom::ends);
        for (std::size_t i = 1; i <= count; ++i) {
            const auto triangle = static_cast<std::uint32_t>(random() % scene.triangles.size());
            const auto lone = static_cast<std::uint16_t>(random() % 3);
            const auto next = static_cast<std::uint16_t>((lone + 1 + random() % 2) % 3);
            const float weight0 = on_side(), weight1 = on_side();
            origins.push_back({weight0, weight1, triangle, lone, next});
            SpanValues& span = values.emplace_back(SpanValues{
                coordinate(random), 0.1f * coordinate(random), coordinate(random), 0.1f * coordinate(random), {}, {}});
            span.value0[3] = coordinate(random);
            span.difference[3] = coordinate(random);
            const std::size_t kind = random() % 4;
            from.push_back(kind == 0 ? RadianceFrom::ends : kind == 1 ? RadianceFrom::samples : RadianceFrom::cache);
            if (kind == 0)
                for (int c = 0; c < 3; ++c) span.value0[c] = fraction(random), span.difference[c] = fraction(random);
        }
    }

    // Sets up the spans as before shading a plane.
    void start(ShadedSpans& shaded) const {
        shaded.clear(values[0]);
        for (std::size_t i = 1; i < values.size(); ++i) {
            if (from[i] == RadianceFrom::ends)
                shaded.add_between_ends(values[i]);
            else
                shaded.add(values[i], from[i]);
        }
    }

    Rgb radiance(std::size_t span, float position, std::size_t column, std::size_t k) const override {
        EXPECT_NE(span, EpipolarPlane::background);
        return {float(span) + position, float(column), float(k)};
    }
    Weights weights_at(std::size_t span, float position) const { return origins[span].weights(position); }
    Grids grids() const override { return {origins.data(), scene.radiance_cache->grids().data()}; }
    shading::RadianceCache::Corners corners(std::size_t span, std::size_t row, std::size_t column) const override {
        ++points_filled;
        return scene.radiance_cache->corners(scene, origins[span].triangle, row, column);
    }
};

struct OutputRows {
    std::vector<std::vector<float, CacheLineAllocator<float>>> rows;
    PlaneOutput plane{};

    OutputRows(std::size_t size, std::size_t directions, std::size_t offset, bool colour, bool depth) : rows(4) {
        for (std::size_t i = 0; i < 4; ++i) {
            rows[i].assign(size + 1, -1);
            plane.values[i] = (i == 3 ? depth : colour || i == 0) ? &rows[i][offset] : nullptr;
            plane.strides[i] = directions;
        }
    }
};

HOGEL_TEST_ON_EVERY_TARGET(KnotKernels);

// Words of a plane that see random spans, with runs of one span.
std::vector<std::uint64_t> random_words(std::mt19937& random, std::size_t size) {
    std::vector<std::uint64_t> words(size + EpipolarPlane::padding, EpipolarPlane::empty);
    for (std::uint64_t& word : std::span(words).first(size))
        if (random() % 4 != 0) word = std::uint64_t{12345} << 32 | (1 + random() % 40);
    for (std::size_t i = 1; i < size; ++i)
        if (i / 32 % 2 == 1 && i % 32 != 0) words[i] = words[i - 1];
    return words;
}

// Compares values with the background and with the depth and, if it is linear, the light of cached spans.
void expect_values(const EpipolarPlane& plane, const TestSpans& spans, bool linear, std::size_t offset,
                   const OutputRows& out) {
    const bool colour = out.plane.values[1] != nullptr, depth = out.plane.values[3] != nullptr;
    for (std::size_t i = 0; i < plane.columns * plane.directions; ++i) {
        const std::size_t number = plane.words[i] & 0xffffffff;
        if (number == EpipolarPlane::background) {
            ASSERT_EQ(out.rows[0][i + offset], 10);
            ASSERT_EQ(out.rows[3][i + offset], depth ? spans.values[0].value0[3] : -1);
            continue;
        }
        if (spans.from[number] != RadianceFrom::cache) continue;
        const SpanValues& values = spans.values[number];
        const float position = position_on_span(values, -3 + float(i / plane.directions),
                                                plane.first_direction + float(i % plane.directions));
        ASSERT_NEAR(out.rows[3][i + offset], depth ? values.value0[3] + position * values.difference[3] : -1, 1e-4);
        if (!linear) continue;
        const Weights w = spans.weights_at(number, position);
        const Rgb radiance = radiance_at(spans.scene, spans.origins[number].triangle, w[0], w[1], w[2]);
        ASSERT_NEAR(out.rows[0][i + offset], colour ? radiance.r : luminance(radiance), 2e-5);
    }
}

TEST_P(KnotKernels, twins_agree_and_reproduce_the_cache) {
    std::mt19937 random(1);
    ShadedSpans shaded;
    std::size_t points_filled = 0;
    for (const std::size_t directions : {1, 7, 16, 64, 67, 128, 150}) {
        const bool linear = directions % 4 != 0;
        // Spacings for which spans have few knots, many, or too many to be filled in advance.
        const ShadedScene scene = lit_triangles(directions == 67 ? 0.003f : directions % 2 == 0 ? 0.3f : 0.03f, linear);
        const TestSpans spans(scene, random, 40);
        constexpr std::size_t columns = 3;
        const std::size_t size = columns * directions;
        std::vector<std::uint64_t> words = random_words(random, size);
        const EpipolarPlane plane{words.data(), nullptr, columns, directions, -3, 0.5f - 0.5f * float(directions)};
        for (const bool colour : {true, false})
            for (const bool depth : {true, false})
                for (const std::size_t offset : {0, 1}) {
                    OutputRows fast(size, directions, offset, colour, depth),
                        plain(size, directions, offset, colour, depth);
                    // The first of these rounds fills the points of the cache.
                    const std::vector<std::uint64_t> before = words, emptied(words.size(), EpipolarPlane::empty);
                    spans.start(shaded);
                    shade_between_knots(plane, spans.values, shaded, spans, fast.plane);
                    ASSERT_EQ(words, emptied);
                    std::ranges::copy(before, words.begin());
                    spans.start(shaded);
                    shade_between_knots_plain(plane, spans.values, shaded, spans, plain.plane);
                    ASSERT_EQ(words, emptied);
                    std::ranges::copy(before, words.begin());
                    ASSERT_EQ(fast.rows, plain.rows) << directions;
                    expect_values(plane, spans, linear, offset, plain);
                }
        points_filled += spans.points_filled;
    }
    EXPECT_GT(points_filled, 0u);
}

// Knots lie closer to each other than points of the cache, so that interpolating twice keeps the order.
TEST(ShadedSpans, show_a_wave_to_second_order) {
    std::vector<double> worst;
    for (const float spacing : {0.08f, 0.04f, 0.02f}) {
        const ShadedScene scene = lit_triangles(spacing, false);
        std::mt19937 random(7);
        const TestSpans spans(scene, random, 60);
        ShadedSpans shaded;
        spans.start(shaded);
        worst.push_back(0);
        for (std::size_t number = 1; number < spans.values.size(); ++number) {
            // Only on the large triangle, whose points are dense along both axes.
            if (spans.from[number] != RadianceFrom::cache || spans.origins[number].triangle % 5 != 0) continue;
            std::vector<std::uint64_t> words(256, std::uint64_t{12345} << 32 | number);
            const EpipolarPlane plane{words.data(), nullptr, 4, 64, -2, -31.5f};
            OutputRows values(words.size(), 64, 0, true, false);
            shade_between_knots_plain(plane, spans.values, shaded, spans, values.plane);
            for (std::size_t i = 0; i < words.size(); ++i) {
                const float position =
                    position_on_span(spans.values[number], -2 + float(i / 64), -31.5f + float(i % 64));
                std::array<float, 3> truth;
                scene.lighting->light_on(scene, spans.origins[number].triangle, spans.weights_at(number, position),
                                         truth);
                for (std::size_t c = 0; c < 3; ++c)
                    worst.back() =
                        std::max(worst.back(), double(std::abs(values.rows[c][i] - std::max(0.0f, truth[c]))));
            }
        }
    }
    EXPECT_LT(worst[0], 0.06);
    EXPECT_LT(worst[1], worst[0] / 2.5);
    EXPECT_LT(worst[2], worst[1] / 2.5);
}

}  // namespace
}  // namespace hogel::render::epi
