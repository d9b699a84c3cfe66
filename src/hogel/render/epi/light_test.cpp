// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "hogel/render/sample_store.h"
#include "hogel/render/test_triangles.h"

namespace hogel::render::epi {
namespace {

using Weights = std::array<float, 3>;

// Light that is linear on each triangle, or a wave, below zero too, as no lamp would make it.
class SomeLight final : public SampleLighting {
  public:
    explicit SomeLight(bool linear) : linear_(linear) {}
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

// A broad triangle, slivers, small ones, each listed from any corner on.
ShadedScene lit_triangles(float spacing, bool linear) {
    ShadedScene scene;
    scene.positions = {{-1, -1, 0}, {1, -0.9, 0.2}, {0.1, 1, -0.3}, {-0.99, -1, 0}, {0.1, 1.01, -0.3}, {-1, -0.98, 0}};
    for (const std::array<std::uint32_t, 3>& corners :
         {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 3, 2}, {2, 0, 3}, {1, 2, 4}, {3, 0, 5}, {2, 0, 1}})
        scene.triangles.push_back({corners, ShadedScene::no_texture, 0});
    scene.radiance.resize(scene.positions.size());
    scene.texture_coordinates.resize(scene.positions.size());
    scene.lighting = std::make_shared<SomeLight>(linear);
    shading::add_radiance_cache(scene, std::vector<float>(scene.triangles.size(), spacing));
    return scene;
}

// Strips of one plane, each from one place on a triangle to another, but for number 0, the background.
struct Strips final : SampleSource {
    const ShadedScene& scene;
    std::vector<StripShades> shades;
    std::vector<LightFrom> from;
    std::vector<StripOrigin> origins;
    mutable std::size_t points_asked = 0;

    Strips(const ShadedScene& lit, std::mt19937& random, std::size_t count) : scene(lit) {
        std::uniform_real_distribution<float> part(0, 1), place(-25, 25);
        const auto on_side = [&] { return random() % 5 == 0 ? 0.0f : part(random); };  // or at a corner
        origins.emplace_back();
        shades.push_back({0, 0, 1, 0, {10, 20, 30, std::numeric_limits<float>::infinity()}, {}});
        from.push_back(LightFrom::ends);
        for (std::size_t i = 1; i <= count; ++i) {
            const auto triangle = static_cast<std::uint32_t>(random() % scene.triangles.size());
            const auto lone = static_cast<std::uint16_t>(random() % 3);
            const auto next = static_cast<std::uint16_t>((lone + 1 + random() % 2) % 3);
            const float weight0 = on_side(), weight1 = on_side();
            origins.push_back({weight0, weight1, triangle, lone, next});
            StripShades& strip = shades.emplace_back(
                StripShades{place(random), 0.1f * place(random), place(random), 0.1f * place(random), {}, {}});
            strip.value0[3] = place(random);
            strip.difference[3] = place(random);
            const std::size_t kind = random() % 4;
            from.push_back(kind == 0 ? LightFrom::ends : kind == 1 ? LightFrom::samples : LightFrom::points);
            if (kind == 0)
                for (int c = 0; c < 3; ++c) strip.value0[c] = part(random), strip.difference[c] = part(random);
        }
    }

    // As they are before a plane is shaded.
    void start(LitStrips& lit) const {
        lit.clear(shades[0]);
        for (std::size_t i = 1; i < shades.size(); ++i) {
            if (from[i] == LightFrom::ends)
                lit.add_lit_at_ends(shades[i]);
            else
                lit.add_lit(shades[i], from[i]);
        }
    }

    Rgb radiance(std::size_t strip, float part, std::size_t column, std::size_t k) const override {
        EXPECT_NE(strip, EpipolarPlane::nobody);
        return {float(strip) + part, float(column), float(k)};
    }
    Weights weights_at(std::size_t strip, float part) const { return origins[strip].weights(part); }
    Grids grids() const override { return {origins.data(), scene.radiance_cache->grids().data()}; }
    shading::RadianceCache::Corners corners(std::size_t strip, std::size_t row, std::size_t column) const override {
        ++points_asked;
        return scene.radiance_cache->corners(scene, origins[strip].triangle, row, column);
    }
};

struct RayValues {
    std::vector<std::vector<float, CacheLineAllocator<float>>> rows;
    ShadedPlane plane{};

    RayValues(std::size_t size, std::size_t directions, std::size_t offset, bool colour, bool depth) : rows(4) {
        for (std::size_t i = 0; i < 4; ++i) {
            rows[i].assign(size + 1, -1);
            plane.values[i] = (i == 3 ? depth : colour || i == 0) ? &rows[i][offset] : nullptr;
            plane.strides[i] = directions;
        }
    }
};

class EveryTargetOfLight : public KernelTargetTest {};
INSTANTIATE_TEST_SUITE_P(EpipolarLight, EveryTargetOfLight, ::testing::ValuesIn(kernel_targets()));

TEST_P(EveryTargetOfLight, vector_and_plain_shadings_are_the_same_and_show_what_the_cache_has) {
    std::mt19937 random(1);
    LitStrips lit;
    std::size_t points_asked = 0;
    for (const std::size_t directions : {1, 7, 16, 64, 67, 128, 150}) {
        const bool linear = directions % 4 != 0;
        // So that strips have few cells, many, or more than are made before they are needed.
        const ShadedScene scene = lit_triangles(directions == 67 ? 0.003f : directions % 2 == 0 ? 0.3f : 0.03f, linear);
        const Strips strips(scene, random, 40);
        constexpr std::size_t columns = 3;
        const std::size_t size = columns * directions;
        std::vector<std::uint64_t> words(size + EpipolarPlane::spare, EpipolarPlane::nothing);
        for (std::uint64_t& word : std::span(words).first(size))
            if (random() % 4 != 0) word = std::uint64_t{12345} << 32 | (1 + random() % 40);
        // Neighbours often see the same strip.
        for (std::size_t i = 1; i < size; ++i)
            if (i / 32 % 2 == 1 && i % 32 != 0) words[i] = words[i - 1];
        const EpipolarPlane plane{words.data(), nullptr, columns, directions, -3, 0.5f - 0.5f * float(directions)};
        for (const bool colour : {true, false})
            for (const bool depth : {true, false})
                for (const std::size_t offset : {0, 1}) {
                    RayValues fast(size, directions, offset, colour, depth),
                        plain(size, directions, offset, colour, depth);
                    // In the first round the points have yet to be made.
                    const std::vector<std::uint64_t> before = words, emptied(words.size(), EpipolarPlane::nothing);
                    strips.start(lit);
                    shade_lit(plane, strips.shades, lit, strips, fast.plane);
                    ASSERT_EQ(words, emptied);
                    std::ranges::copy(before, words.begin());
                    strips.start(lit);
                    shade_lit_plain(plane, strips.shades, lit, strips, plain.plane);
                    ASSERT_EQ(words, emptied);
                    std::ranges::copy(before, words.begin());
                    ASSERT_EQ(fast.rows, plain.rows) << directions;
                    for (std::size_t i = 0; i < size; ++i) {
                        const std::size_t number = words[i] & 0xffffffff;
                        if (words[i] == EpipolarPlane::nothing) {
                            ASSERT_EQ(plain.rows[0][i + offset], 10);
                            ASSERT_EQ(plain.rows[3][i + offset], depth ? strips.shades[0].value0[3] : -1);
                            continue;
                        }
                        if (strips.from[number] != LightFrom::points) continue;
                        const StripShades& shades = strips.shades[number];
                        const float part = part_of_strip(shades, -3 + float(i / directions),
                                                         plane.first_direction + float(i % directions));
                        ASSERT_NEAR(plain.rows[3][i + offset],
                                    depth ? shades.value0[3] + part * shades.difference[3] : -1, 1e-4);
                        if (!linear) continue;
                        const Weights w = strips.weights_at(number, part);
                        const Rgb seen = radiance_at(scene, strips.origins[number].triangle, w[0], w[1], w[2]);
                        ASSERT_NEAR(plain.rows[0][i + offset], colour ? seen.r : luminance(seen), 2e-5);
                    }
                }
        points_asked += strips.points_asked;
    }
    EXPECT_GT(points_asked, 0u);
}

// The nodes along a strip lie closer than the points, so that what is kept is shown to second order.
TEST(EpipolarLight, shows_a_wave_to_second_order) {
    std::vector<double> worst;
    for (const float spacing : {0.08f, 0.04f, 0.02f}) {
        const ShadedScene scene = lit_triangles(spacing, false);
        std::mt19937 random(7);
        const Strips strips(scene, random, 60);
        LitStrips lit;
        strips.start(lit);
        worst.push_back(0);
        for (std::size_t number = 1; number < strips.shades.size(); ++number) {
            // On the broad triangle, whose points lie close both ways.
            if (strips.from[number] != LightFrom::points || strips.origins[number].triangle % 5 != 0) continue;
            std::vector<std::uint64_t> words(256, std::uint64_t{12345} << 32 | number);
            const EpipolarPlane plane{words.data(), nullptr, 4, 64, -2, -31.5f};
            RayValues values(words.size(), 64, 0, true, false);
            shade_lit_plain(plane, strips.shades, lit, strips, values.plane);
            for (std::size_t i = 0; i < words.size(); ++i) {
                const float part = part_of_strip(strips.shades[number], -2 + float(i / 64), -31.5f + float(i % 64));
                std::array<float, 3> truth;
                scene.lighting->light_on(scene, strips.origins[number].triangle, strips.weights_at(number, part),
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
