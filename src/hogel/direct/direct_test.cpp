// SPDX-License-Identifier: Apache-2.0
// Compares the methods from scenes to fields with each other, and photographs of their holograms with geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/core/test_targets.h"
#include "hogel/direct/exact_sums.h"
#include "hogel/direct/fresnel_integral.h"
#include "hogel/direct/line_source.h"
#include "hogel/direct/scene_points.h"
#include "hogel/error.h"
#include "hogel/photograph.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::direct {
namespace {

using namespace literals;
using Complex = std::complex<double>;

// A parallelogram of one radiance, two triangles.
void add_card(ShadedScene& scene, Vec3 corner, Vec3 across, Vec3 up, float radiance) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const Vec3& p : {corner, corner + across, corner + across + up, corner + up}) {
        scene.positions.push_back(p);
        scene.radiance.push_back({radiance, radiance, radiance});
    }
    scene.texture_coordinates.resize(scene.positions.size());
    const std::uint32_t mesh = first / 4;
    scene.triangles.push_back({{first, first + 1, first + 2}, ShadedScene::no_texture, mesh});
    scene.triangles.push_back({{first, first + 2, first + 3}, ShadedScene::no_texture, mesh});
}

ShadedScene card_at(double depth, double half, float radiance = 1, double slope = 0) {
    ShadedScene scene;
    add_card(scene, {-half, -half, -depth + slope * half}, {2 * half, 0, -2 * half * slope}, {0, 2 * half, 0},
             radiance);
    return scene;
}

double difference(const Field& a, const Field& b) {
    double error = 0, energy = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
        error += std::norm(a.samples.data()[i] - b.samples.data()[i]);
        energy += std::norm(a.samples.data()[i]);
    }
    return std::sqrt(error / energy);
}

const FieldGrid small{{96, 80, 2_um, 2_um, 0, 0}, 633_nm};

Field make(std::string_view method, const ShadedScene& scene, const FieldGrid& grid,
           const SceneHologramOptions& options = {}) {
    return scene_hologram_methods().find(method).make(scene, grid, options, {});
}

TEST(TiledPoints, equal_the_exact_sum_near_and_far) {
    SceneHologramOptions options;
    options.spacing = 20_um;
    for (const double depth : {2_mm, -0.8_mm, 120_um}) {
        const ShadedScene scene = card_at(depth, 0.07_mm, 1, 0.15);
        const Field exact = make("points-visible", scene, small, options);
        EXPECT_LT(difference(exact, make("points-tiled", scene, small, options)), 0.02) << depth;
        // A card does not occlude itself.
        EXPECT_LT(difference(exact, make("points", scene, small, options)), 1e-6);
    }
}

TEST(FresnelIntegral, equals_the_handbook_and_its_plain_version) {
    // Abramowitz and Stegun, table 7.7.
    EXPECT_NEAR(fresnel_integral_plain(1).real(), 0.7798934, 1e-7);
    EXPECT_NEAR(fresnel_integral_plain(1).imag(), 0.4382591, 1e-7);
    EXPECT_NEAR(fresnel_integral_plain(3).real(), 0.6057208, 1e-7);
    EXPECT_NEAR(fresnel_integral_plain(3).imag(), 0.4963130, 1e-7);
    for (double w = -12; w < 12; w += 0.00317)
        ASSERT_LT(std::abs(fresnel_integral(w) - fresnel_integral_plain(w)), 3e-7) << w;
}

TEST(LineSource, equals_the_sum_of_its_points) {
    for (const double side : {1.0, -1.0}) {
        LineSource line{{-0.1_mm, 0.05_mm, -side * 2_mm}, {0.12_mm, -0.04_mm, -side * 2.03_mm}, 0.7, -0.12, 0.3};
        const double size = length(line.b - line.a);
        double error = 0, energy = 0;
        for (double x = -0.2_mm; x < 0.2_mm; x += 7_um)
            for (double y = -0.15_mm; y < 0.15_mm; y += 11_um) {
                constexpr int steps = 4000;
                Complex sum = 0;
                for (int i = 0; i < steps; ++i) {
                    const double l = (i + 0.5) / steps * size;
                    const double r = length(Vec3{x, y, 0} - line.a - l / size * (line.b - line.a));
                    sum += std::polar(0.7 / r * size / steps,
                                      side * 2 * std::numbers::pi * ((r + line.slope * l) / 633e-9 + side * 0.3));
                }
                error += std::norm(sum - line_wave(line, {x, y, 0}, 633_nm));
                energy += std::norm(sum);
            }
        EXPECT_LT(std::sqrt(error / energy), 0.05) << side;
    }
}

// A photograph through a wide lens, which blurs surfaces out of focus and sees around small occluders.
Image photo(const Field& field, double focus, const Grid& picture) {
    Camera camera;
    camera.eye = {0, 0, 40_mm};
    camera.pupil = 3_mm;
    camera.focus_depth = focus;
    camera.picture = picture;
    return photograph(field, std::span(&camera, 1))[0];
}

double mean(const Image& image) {
    double sum = 0;
    for (const float value : image.pixels.elements()) sum += value;
    return sum / static_cast<double>(image.pixels.size());
}

class SurfaceMethod : public testing::TestWithParam<const char*> {};

// A photograph shows a diffuse card's radiance, behind and in front of the hologram, upright and tilted.
TEST_P(SurfaceMethod, photographs_a_card_with_its_own_radiance) {
    const std::string method = GetParam();
    const FieldGrid grid{{200, 200, 2_um, 2_um, 0, 0}, 633_nm};
    SceneHologramOptions options;
    options.planes = 4;
    // The lines of the hologram must be low enough to light the whole lens.
    options.spacing = method == "points-hpo" ? 5_um : 24_um;
    for (const double depth : {1.2_mm, -1.2_mm})
        for (const double slope : {0.0, 0.15}) {
            const Field field = make(method, card_at(depth, 0.14_mm, 2, slope), grid, options);
            const Grid inside{4, 4, 40_um, 40_um, 0, 0};
            EXPECT_NEAR(mean(photo(field, depth, inside)), 2, 0.35) << depth << " " << slope;
            // The picture is dark beside the card.
            EXPECT_LT(mean(photo(field, depth, {1, 4, 20_um, 40_um, 0.185_mm, 0})), 0.2) << depth << " " << slope;
        }
}

INSTANTIATE_TEST_SUITE_P(Methods, SurfaceMethod,
                         testing::Values("points-visible", "points-tiled", "points-hpo", "fresnel", "planes",
                                         "polygons", "polygons-visible"));

class HidingMethod : public testing::TestWithParam<const char*> {};

// A dark card hides the left half of a bright one. Without occlusion the bright one is visible through it.
TEST_P(HidingMethod, hides_surfaces_behind_others) {
    const std::string method = GetParam();
    const FieldGrid grid{{200, 200, 2_um, 2_um, 0, 0}, 633_nm};
    ShadedScene scene = card_at(1.6_mm, 0.16_mm, 1);
    add_card(scene, {-0.16_mm, -0.16_mm, -0.8_mm}, {0.16_mm, 0, 0}, {0, 0.32_mm, 0}, 0.0f);
    SceneHologramOptions options;
    options.planes = 3;
    options.spacing = method == "points-hpo" ? 5_um : 30_um;
    const Field field = make(method, scene, grid, options);
    const double left = mean(photo(field, 0.8_mm, {1, 3, 40_um, 60_um, -70_um, 0}));
    const double right = mean(photo(field, 1.6_mm, {1, 3, 40_um, 60_um, 80_um, 0}));
    EXPECT_NEAR(right, 1, 0.3);
    const bool hides = method != "points" && method != "polygons";
    EXPECT_TRUE(hides ? left < 0.15 : left > 0.5) << left;
}

INSTANTIATE_TEST_SUITE_P(Methods, HidingMethod,
                         testing::Values("points", "points-visible", "points-tiled", "points-hpo", "planes", "polygons",
                                         "polygons-visible"));

class EdgeMethod : public testing::TestWithParam<const char*> {};

TEST_P(EdgeMethod, shows_a_card_by_its_outline) {
    const FieldGrid grid{{200, 200, 2_um, 2_um, 0, 0}, 633_nm};
    SceneHologramOptions options;
    options.spacing = 5_um;
    const Field field = make(GetParam(), card_at(1.5_mm, 0.1_mm), grid, options);
    const double edge = mean(photo(field, 1.5_mm, {1, 4, 16_um, 30_um, 0.1_mm, 0}));
    EXPECT_GT(edge, 5 * mean(photo(field, 1.5_mm, {4, 4, 25_um, 25_um, 0, 0})));
    EXPECT_GT(edge, 5 * mean(photo(field, 1.5_mm, {1, 4, 16_um, 30_um, 0.16_mm, 0})));
}

INSTANTIATE_TEST_SUITE_P(Methods, EdgeMethod, testing::Values("edges", "segments"));

TEST(FresnelPlanes, a_small_patch_is_the_sum_of_its_points_in_the_near_and_far_field) {
    // One sample of the plane's own grid, 633 nm · 4 mm / (128 · 2 µm) wide, in the middle of its cell.
    const FieldGrid grid{{128, 128, 2_um, 2_um, 0, 0}, 633_nm};
    const double pitch = 633e-9 * 4e-3 / (128 * 2e-6);
    ShadedScene scene;
    add_card(scene, {0.1 * pitch, 0.1 * pitch, -4_mm}, {0.8 * pitch, 0, 0}, {0, 0.8 * pitch, 0}, 1);
    const Vec3 at{0.5 * pitch, 0.5 * pitch, -4_mm};
    for (const char* method : {"fresnel", "fraunhofer"}) {
        const Field field = make(method, scene, grid);
        Complex product = 0;
        double energy = 0, other = 0;
        for (std::size_t row = 0; row < 128; ++row)
            for (std::size_t column = 0; column < 128; ++column) {
                const double r = length(Vec3{grid.plane.x(double(column)), grid.plane.y(double(row)), 0} - at);
                const Complex value = field.samples(row, column);
                product += value * std::polar(1.0 / r, -2 * std::numbers::pi * r / 633e-9);
                energy += std::norm(value);
                other += 1 / (r * r);
            }
        EXPECT_NEAR(std::norm(product) / (energy * other), 1, 0.01) << method;
        // √L λ/δ · δ²/(λ r): the sample's whole cell emits.
        EXPECT_NEAR(std::sqrt(energy / other), pitch, 0.01 * pitch);
    }
}

HOGEL_TEST_ON_EVERY_TARGET(AddWave);

TEST_P(AddWave, equals_its_plain_version_behind_and_in_front_of_the_hologram) {
    const FieldGrid grid{{64, 64, 2_um, 3_um, 0, 0}, 633_nm};
    const SampleRow row{-30_um, 12_um, 2_um};
    std::array<bool, tile_side> hidden{};
    hidden[3] = hidden[17] = true;
    for (const double z : {-0.2_mm, 0.15_mm, -30_mm})
        for (const Vec3 normal : {Vec3{}, normalize(Vec3{0.3, -0.2, 1})})
            for (const bool* mask : {static_cast<const bool*>(nullptr), static_cast<const bool*>(hidden.data())}) {
                const Vec3 at{5_um, -7_um, z};
                const ScenePoint point{at, at, normal, 2, 0.3};
                std::array<double, tile_side> re{}, im{}, fast_re{}, fast_im{};
                add_wave_plain(point, grid, row, mask, re.data(), im.data());
                add_wave(point, grid, row, mask, fast_re.data(), fast_im.data());
                for (std::size_t i = 0; i < tile_side; ++i) {
                    EXPECT_NEAR(re[i], fast_re[i], 1e-9 * 2 / std::abs(z)) << i << " " << z;
                    EXPECT_NEAR(im[i], fast_im[i], 1e-9 * 2 / std::abs(z)) << i << " " << z;
                }
            }
}

// Threads compute tiles of the field; random numbers depend on the point, never on the order of work.
TEST(SceneHologramMethods, give_the_same_bytes_for_any_number_of_threads_and_others_for_another_seed) {
    // The card is far enough for all methods and small enough for the far-field method.
    const ShadedScene scene = card_at(12_mm, 0.03_mm, 1, 0.1);
    for (const SceneHologramMethod& method : scene_hologram_methods().rows()) {
        SceneHologramOptions options;
        options.planes = 3;
        const auto make_with = [&](std::size_t threads) {
            const ThreadLimit limit(threads);
            return method.make(scene, small, options, {});
        };
        const Field one = make_with(1), three = make_with(3);
        options.seed = 2;
        const Field other = make_with(3);
        double energy = 0;
        for (const auto& value : one.samples.elements()) energy += std::norm(value);
        EXPECT_GT(energy, 0) << method.name;
        EXPECT_TRUE(std::ranges::equal(one.samples.elements(), three.samples.elements())) << method.name;
        EXPECT_FALSE(std::ranges::equal(one.samples.elements(), other.samples.elements())) << method.name;
    }
}

TEST(SceneHologramMethods, refuse_scenes_and_grids_that_they_cannot_take) {
    const auto message = [](const char* method, const ShadedScene& scene) -> std::string {
        try {
            make(method, scene, small);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return error.what();
        }
        return "";
    };
    EXPECT_NE(message("fresnel", card_at(0.5_mm, 0.1_mm)).find("expected a depth of"), std::string::npos);
    EXPECT_NE(message("fresnel", card_at(0, 0.1_mm)).find("lies on the hologram"), std::string::npos);
    EXPECT_NE(message("fraunhofer", card_at(5_mm, 0.1_mm)).find("is in the far field from"), std::string::npos);
    EXPECT_THROW(scene_hologram_methods().find("wavy"), Error);
}

TEST(ScenePoints, more_of_them_than_memory_holds_are_refused_with_a_spacing_that_would_do) {
    SceneHologramOptions options;
    options.spacing = 1e-3_nm;
    for (const char* method : {"points", "points-visible", "points-tiled", "points-hpo"}) try {
            make(method, card_at(2_mm, 1_mm), small, options);
            ADD_FAILURE() << method;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage) << method;
            EXPECT_NE(std::string(error.what()).find("expected at most 1e+08"), std::string::npos) << error.what();
        }
    options.spacing = 1e-6_nm;
    EXPECT_THROW(make("edges", card_at(2_mm, 1_mm), small, options), Error);
}

}  // namespace
}  // namespace hogel::direct
