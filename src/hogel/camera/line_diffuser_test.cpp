// SPDX-License-Identifier: Apache-2.0
// Holograms with horizontal parallax only behind a vertical diffuser.
#include "hogel/camera/line_diffuser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::camera {
namespace {

using namespace literals;

const BandCamera diffuse{.vertical_diffuser = true};

// Random samples: uniform light in all directions to which the pitch along x diffracts.
Field random_lines(const FieldGrid& grid, unsigned seed) {
    Field field(grid);
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    for (auto& value : field.samples.elements()) value = {normal(random), normal(random)};
    return field;
}

Camera camera_at(Vec3 eye, double pupil, double focus, const Grid& picture) {
    Camera camera;
    camera.eye = eye;
    camera.pupil = pupil;
    camera.focus_depth = focus;
    camera.picture = picture;
    return camera;
}

double sum_behind_diffuser(const Image& image) {
    double total = 0;
    for (const float value : image.pixels.elements()) total += value;
    return total;
}

double relative_difference(const Image& a, const Image& b) {
    double error = 0, power = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        error += std::pow(double(a.pixels.data()[i]) - double(b.pixels.data()[i]), 2);
        power += std::pow(double(b.pixels.data()[i]), 2);
    }
    return std::sqrt(error / power);
}

// The sum, over lines and heights within a line, of photographs by direct summation.
TEST(LineDiffuser, is_the_sum_of_the_intensities_of_all_heights_by_direct_summation) {
    const FieldGrid grid{{300, 4, 4_um, 80_um, 0, 0}, 633_nm};
    const Field field = random_lines(grid, 1);
    for (const double focus : {0_mm, 2_mm}) {
        const Camera camera = camera_at({3_mm, -8_mm, 60_mm}, 1_mm, focus, {10, 6, 40_um, 35_um, 10_um, -5_um});
        const Image found = photograph(field, {&camera, 1}, diffuse).front();
        Image expected(10, 6, 1);
        constexpr std::size_t heights = 6;
        for (std::size_t line = 0; line < 4; ++line)
            for (std::size_t i = 0; i < heights; ++i) {
                const double up = ((double(i) + 0.5) / double(heights) - 0.5) * 80_um;
                const FieldGrid one{{300, 1, 4_um, 80_um, 0, grid.plane.y(double(line)) + up}, 633_nm};
                Field alone(one);
                field.read({0, line, 300, 1}, 0, alone.samples);
                const Image height = photograph(alone, {&camera, 1}, DirectCamera{72, 4}).front();
                for (std::size_t k = 0; k < expected.pixels.size(); ++k)
                    expected.pixels.data()[k] += height.pixels.data()[k] / float(heights);
            }
        EXPECT_LT(relative_difference(found, expected), 0.008) << focus;
        EXPECT_NEAR(sum_behind_diffuser(found) / sum_behind_diffuser(expected), 1, 0.003) << focus;
    }
}

// Lines without overlapping light share a photograph.
TEST(LineDiffuser, lines_that_are_far_apart_do_not_change_each_other) {
    const FieldGrid grid{{400, 40, 6_um, 62.5_um, 0, 0}, 633_nm};
    const Field field = random_lines(grid, 2);
    const std::vector<Camera> cameras{camera_at({2_mm, 5_mm, 100_mm}, 3_mm, 0, {12, 14, 150_um, 150_um, 0, 0}),
                                      camera_at({2_mm, 5_mm, 100_mm}, 3_mm, 2_mm, {12, 14, 150_um, 150_um, 0, 0})};
    std::vector<Image> together(2), alone(2);
    photograph_lines(field, cameras, diffuse, together, {});
    photograph_lines(field, cameras, diffuse, alone, {}, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(relative_difference(together[i], alone[i]), 0.004) << i;
}

// A field of independent samples has the spectral density |F|² Δx Δy, Lλ²/cos θ for the radiance L. It is visible from
// any height, though lines so far apart diffract by 0.3 degrees only.
TEST(LineDiffuser, uniform_light_has_its_radiance_from_all_heights) {
    const FieldGrid grid{{500, 48, 5_um, 62.5_um, 0, 0}, 633_nm};
    const Field field = random_lines(grid, 3);
    for (const double height : {0_mm, 6_mm, 40_mm}) {
        const Camera camera = camera_at({0, height, 100_mm}, 3_mm, 0, {16, 20, 120_um, 120_um, 0, 0});
        const Image seen = photograph(field, {&camera, 1}, diffuse).front();
        const double cosine = 100_mm / std::hypot(100_mm, height);
        const double expected = 2 * 5_um * 62.5_um * cosine / (633_nm * 633_nm);
        EXPECT_NEAR(sum_behind_diffuser(seen) / double(seen.pixels.size()) / expected, 1, 0.03) << height;
        EXPECT_THROW(require_light_towards(grid, camera), Error);
        require_light_towards(grid, camera, true);
    }
}

// The light of a point behind the hologram, on one line: it appears on its line, where the line of sight meets it.
TEST(LineDiffuser, a_point_is_in_its_place_across_and_on_its_line) {
    const FieldGrid grid{{1500, 48, 4_um, 62.5_um, 0, 0}, 633_nm};
    const double x = 0.7_mm, depth = 8_mm, k = 2 * std::numbers::pi / 633_nm;
    const std::size_t line = 15;
    Field field(grid);
    for (std::size_t i = 0; i < 1500; ++i) {
        const double aside = grid.plane.x(double(i)) - x, r = std::hypot(aside, depth);
        if (std::abs(aside) < 0.075 * r)  // farther aside samples are too far apart for the wave
            field.samples(line, i) = std::complex<float>(std::polar(1.0, k * r));
    }
    for (const Vec3 eye : {Vec3{0, 0, 200_mm}, Vec3{9_mm, 30_mm, 200_mm}, Vec3{-9_mm, -12_mm, 200_mm}}) {
        const Camera camera = camera_at(eye, 4_mm, depth, {120, 60, 25_um, 50_um, 0.4_mm, 0});
        const Image seen = photograph(field, {&camera, 1}, diffuse).front();
        std::vector<double> columns(120);
        double height = 0, total = 0;
        for (std::size_t row = 0; row < 60; ++row)
            for (std::size_t column = 0; column < 120; ++column) {
                const double value = seen.pixels(row, column, 0);
                columns[column] += value;
                height += value * camera.picture.y(double(row));
                total += value;
            }
        const auto peak = double(std::ranges::max_element(columns) - columns.begin());
        const double wanted = eye.x + (x - eye.x) * eye.z / (eye.z + depth);
        EXPECT_NEAR(camera.picture.x(peak), wanted, 25_um) << eye.x;
        EXPECT_NEAR(height / total, grid.plane.y(double(line)), 20_um) << eye.y;
        // Two resolution cells contain most of it.
        double near = 0;
        for (double at = peak - 2; at <= peak + 2; ++at) near += columns[static_cast<std::size_t>(at)];
        EXPECT_GT(near, 0.8 * total) << eye.x;
    }
}

TEST(LineDiffuser, refuses_what_it_does_not_know) {
    const Field field = random_lines({{64, 4, 4_um, 62.5_um, 0, 0}, 633_nm}, 1);
    const Camera camera = camera_at({0, 0, 60_mm}, 1_mm, 0, {4, 4, 50_um, 50_um, 0, 0});
    const BandCamera from_hogels{.source = BandSource::hogel_spectra, .vertical_diffuser = true};
    EXPECT_THROW(photograph(field, {&camera, 1}, from_hogels), Error);
    EXPECT_THROW(require_photographs(field.grid(), {&camera, 1}, from_hogels), Error);
}

}  // namespace
}  // namespace hogel::camera
