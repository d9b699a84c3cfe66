#include "hogel/render/epi_light_internal.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <vector>

#include "hogel/render/sample_store_internal.h"
#include "hogel/render/test_triangles_internal.h"

namespace hogel {
namespace {

using Weights = std::array<float, 3>;

// Light that changes from place to place, below zero too, as no lamp would make it.
class SomeLight final : public SampleLighting {
  public:
    Size size_of_light(std::size_t) const override { return {3, 0}; }
    bool light_is_radiance(std::size_t) const override { return true; }
    void light_on(const ShadedScene&, std::size_t index, const Weights& w, std::span<float> light) const override {
        for (std::size_t i = 0; i < 3; ++i)
            light[i] = std::sin(float(index + i) + 9 * w[0] + 14 * w[1] * w[2]) + 0.7f * float(i);
    }
};

// A broad triangle, slivers, small ones, each listed from any corner on.
ShadedScene lit_triangles(float spacing) {
    ShadedScene scene;
    scene.positions = {{-1, -1, 0}, {1, -0.9, 0.2}, {0.1, 1, -0.3}, {-0.99, -1, 0}, {0.1, 1.01, -0.3}, {-1, -0.98, 0}};
    for (const std::array<std::uint32_t, 3>& corners :
         {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 3, 2}, {2, 0, 3}, {1, 2, 4}, {3, 0, 5}, {2, 0, 1}})
        scene.triangles.push_back({corners, ShadedScene::no_texture, 0});
    scene.radiance.resize(scene.positions.size());
    scene.texture_coordinates.resize(scene.positions.size());
    scene.lighting = std::make_shared<SomeLight>();
    cache_light(scene, std::vector<float>(scene.triangles.size(), spacing));
    return scene;
}

// Strips of one plane, each from one place on a triangle to another, but for number 0, the background.
struct Strips final : SampleSource {
    const ShadedScene& scene;
    std::vector<StripShades> shades;
    std::vector<StripLight> lights;
    std::vector<std::size_t> triangles;
    std::vector<std::array<Weights, 2>> weights;
    mutable std::size_t points_asked = 0;

    Strips(const ShadedScene& lit, std::mt19937& random, std::size_t count) : scene(lit) {
        std::uniform_real_distribution<float> part(0, 1), place(-25, 25);
        const auto on_side = [&] {  // on a side of the triangle, or at a corner
            Weights w{};
            const float along = random() % 5 == 0 ? 0.0f : part(random);
            const std::size_t first = random() % 3;
            w[first] = 1 - along;
            w[(first + 1) % 3] = along;
            return w;
        };
        triangles.emplace_back();
        weights.emplace_back();
        shades.push_back({0, 0, 1, 0, {10, 20, 30, 40}, {}});
        lights.emplace_back();
        for (std::size_t i = 1; i <= count; ++i) {
            triangles.push_back(random() % scene.triangles.size());
            weights.push_back({on_side(), on_side()});
            StripShades& strip = shades.emplace_back(
                StripShades{place(random), 0.1f * place(random), place(random), 0.1f * place(random), {}, {}});
            strip.value0[3] = place(random);
            strip.difference[3] = place(random);
            StripLight& light = lights.emplace_back();
            switch (random() % 4) {
                case 0:
                    for (int c = 0; c < 3; ++c) strip.value0[c] = part(random), strip.difference[c] = part(random);
                    break;
                case 1:
                    light.from = StripLight::From::samples;
                    break;
                default:
                    light = light_of_points(scene.light_cache->grid(triangles[i]), weights[i][0], weights[i][1]);
            }
        }
    }

    Rgb radiance(std::size_t strip, float part, std::size_t column, std::size_t k) const override {
        return {float(strip) + part, float(column), float(k)};
    }
    LightCache::Corners corners(std::size_t strip, std::size_t row, std::size_t column) const override {
        ++points_asked;
        return scene.light_cache->corners(scene, triangles[strip], row, column);
    }
};

struct Values {
    std::vector<std::vector<float, CacheLineAllocator<float>>> rows;
    ShadedPlane plane{};

    Values(std::size_t size, std::size_t directions, std::size_t offset, bool colour, bool depth) : rows(4) {
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
    for (const std::size_t directions : {1, 7, 16, 64, 67, 128, 150}) {
        const ShadedScene scene = lit_triangles(directions % 2 == 0 ? 0.3f : 0.03f);
        const Strips strips(scene, random, 40);
        constexpr std::size_t columns = 3;
        const std::size_t size = columns * directions;
        std::vector<std::uint64_t> words(size, EpipolarPlane::nothing);
        for (std::uint64_t& word : words)
            if (random() % 4 != 0) word = std::uint64_t{12345} << 32 | (1 + random() % 40);
        const EpipolarPlane plane{words.data(), nullptr, columns, directions, -3, 0.5f - 0.5f * float(directions)};
        for (const bool colour : {true, false})
            for (const bool depth : {true, false})
                for (const std::size_t offset : {0, 1}) {
                    Values fast(size, directions, offset, colour, depth),
                        plain(size, directions, offset, colour, depth);
                    // In the first round the points have yet to be made.
                    const std::vector<std::uint64_t> before = words, emptied(size, EpipolarPlane::nothing);
                    shade_lit(plane, strips.shades, strips.lights, strips, fast.plane);
                    ASSERT_EQ(words, emptied);
                    std::ranges::copy(before, words.begin());
                    shade_lit_plain(plane, strips.shades, strips.lights, strips, plain.plane);
                    ASSERT_EQ(words, emptied);
                    std::ranges::copy(before, words.begin());
                    ASSERT_EQ(fast.rows, plain.rows) << directions;
                    for (std::size_t i = 0; i < size; ++i) {
                        const std::size_t number = words[i] & 0xffffffff;
                        if (words[i] == EpipolarPlane::nothing) {
                            ASSERT_EQ(plain.rows[0][i + offset], 10);
                            continue;
                        }
                        if (!strips.lights[number].points) continue;
                        const float part = part_of_strip(strips.shades[number], -3 + float(i / directions),
                                                         plane.first_direction + float(i % directions));
                        const auto& [w0, w1] = strips.weights[number];
                        Weights w;
                        for (std::size_t k = 0; k < 3; ++k) w[k] = w0[k] + part * (w1[k] - w0[k]);
                        const Rgb seen = radiance_at(scene, strips.triangles[number], w[0], w[1], w[2]);
                        ASSERT_NEAR(plain.rows[0][i + offset], colour ? seen.r : luminance(seen), 2e-3);
                        if (depth) {
                            const StripShades& shades = strips.shades[number];
                            ASSERT_NEAR(plain.rows[3][i + offset], shades.value0[3] + part * shades.difference[3],
                                        1e-4);
                        }
                    }
                }
        EXPECT_GT(strips.points_asked, 0u);
    }
}

}  // namespace
}  // namespace hogel
