// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/test_targets.h"
#include "hogel/hologram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "hogel/error.h"
#include "hogel/photograph.h"
#include "hogel/stereogram/frequency_grid.h"
#include "hogel/stereogram/lobes.h"
#include "hogel/units.h"

namespace hogel::stereogram {
namespace {

using namespace literals;
using Complex = std::complex<float>;

LightFieldBuffer uniform(const LightFieldGrid& grid, float radiance) {
    LightFieldBuffer light_field(grid);
    std::ranges::fill(light_field.radiance.elements(), radiance);
    return light_field;
}

const LightFieldGrid small{8, 6, 64_um, 24, 24, Perspective{0.15, 0.15}, 1};

// A single direction gives one plane wave in the direction of the ray: e^{2πi (f_x x + f_y y)} with f =
// −(U,V)/(λ√(1+U²+V²)), over every hogel, with |F|² = L (λ/d)²/cos θ.
TEST(FourierHologram, one_direction_is_one_plane_wave_with_the_frequency_of_its_ray) {
    HologramOptions options;
    options.channel.wavelength = 633_nm;
    options.pitch = 2_um;
    // Radiance only at the sample nearest to frequency (+3, −2)/d: U and V have the opposite signs.
    const double step = options.channel.wavelength / small.pitch, sx = 3 * step, sy = -2 * step;
    const double cosine = std::sqrt(1 - sx * sx - sy * sy);
    LightFieldGrid grid = small;
    // A grid of directions so fine that one sample lies within one lobe.
    grid.directions_u = grid.directions_v = 151;
    LightFieldBuffer light_field(grid);
    const double U = -sx / cosine, V = -sy / cosine;
    const auto k = static_cast<std::size_t>(std::lround(U / grid.step_u() + 75)),
               l = static_cast<std::size_t>(std::lround(75 - V / grid.step_v()));
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s) light_field.radiance(0, t, s, l, k) = 1;
    const auto hologram = make_hologram(borrow(light_field), options);
    const Grid& plane = hologram->grid().plane;
    Array<Complex, 2> field({plane.height, plane.width});
    hologram->read({0, 0, plane.width, plane.height}, 0, field);
    // The mean of a single sample's hat function over the lobe: the sample's share of the lobe's area.
    const double lobe = step / (grid.step_u() * cosine) * (1 + U * U) * step / (grid.step_v() * cosine) * (1 + V * V);
    const double modulus = std::sqrt(step * step / cosine / lobe);
    const std::size_t n = hologram->alignment();
    ASSERT_EQ(n, 32u);
    for (std::size_t y = 0; y < plane.height; ++y)
        for (std::size_t x = 0; x < plane.width; ++x) {
            const std::size_t x0 = x / n * n,
                              y0 = y / n * n;  // the phase at the hogel's first sample is the random one
            const double cycles = 3 / small.pitch * (plane.x(double(x)) - plane.x(double(x0))) -
                                  2 / small.pitch * (plane.y(double(y)) - plane.y(double(y0)));
            const auto expected = std::complex<double>(field(y0, x0)) * std::polar(1.0, 2 * std::numbers::pi * cycles);
            ASSERT_LT(std::abs(std::complex<double>(field(y, x)) - expected), 1e-4 * modulus) << x << " " << y;
            ASSERT_NEAR(std::abs(field(y, x)), modulus, 1e-3 * modulus);
        }
}

// Parseval: the mean of |F|² over a hogel is Σ_j L (λ/d)²/cos θ_j.
TEST(FourierHologram, carries_the_energy_of_its_light_field) {
    const LightFieldBuffer light_field = uniform(small, 0.7f);
    HologramOptions options;
    options.pitch = 1.6_um;  // 40 samples per hogel
    const auto hologram = make_hologram(borrow(light_field), options);
    const double step = options.channel.wavelength / small.pitch;
    double expected = 0;
    for (int j = -19; j <= 19; ++j)
        for (int i = -19; i <= 19; ++i) {
            const double sine2 = (i * i + j * j) * step * step, cosine = std::sqrt(1 - sine2);
            // Lobes on the border of the field of view are partly inside.
            const auto active = [&](double sine) {
                const double tangent = std::abs(sine) / cosine, half = 0.5 * step * (1 + tangent * tangent) / cosine;
                return std::clamp((0.15 - tangent + half) / (2 * half), 0.0, 1.0);
            };
            expected += 0.7 * active(i * step) * active(j * step) * step * step / cosine;
        }
    Array<Complex, 2> hogel({40, 40});
    hologram->read({80, 40, 40, 40}, 0, hogel);
    double energy = 0;
    for (const Complex& value : hogel.elements()) energy += std::norm(value) / 1600;
    EXPECT_NEAR(energy / expected, 1, 1e-4);
}

TEST(FourierHologram, has_the_same_bytes_in_any_tiling_and_other_phases_for_another_look_or_seed) {
    LightFieldBuffer light_field(small);
    for (std::size_t i = 0; i < light_field.radiance.size(); ++i) light_field.radiance.data()[i] = float(i % 97) / 97;
    HologramOptions options;
    options.pitch = 1.6_um;
    options.looks = 2;
    const auto hologram = make_hologram(borrow(light_field), options);
    const Grid& plane = hologram->grid().plane;
    Array<Complex, 2> whole({plane.height, plane.width});
    hologram->read({0, 0, plane.width, plane.height}, 0, whole);
    for (const Region& region :
         {Region{0, 0, 40, 40}, Region{13, 29, 101, 77}, Region{319, 239, 1, 1}, Region{40, 80, 80, 40}}) {
        Array<Complex, 2> part({region.height, region.width});
        hologram->read(region, 0, part);
        for (std::size_t y = 0; y < region.height; ++y)
            for (std::size_t x = 0; x < region.width; ++x)
                ASSERT_EQ(part(y, x), whole(region.y0 + y, region.x0 + x)) << x << " " << y;
    }
    const auto correlation = [&](const FieldSource& other, std::size_t look) {
        Array<Complex, 2> field({plane.height, plane.width});
        other.read({0, 0, plane.width, plane.height}, look, field);
        std::complex<double> ab = 0;
        double aa = 0, bb = 0;
        for (std::size_t i = 0; i < field.size(); ++i) {
            ab += std::complex<double>(field.data()[i]) * std::conj(std::complex<double>(whole.data()[i]));
            aa += std::norm(field.data()[i]);
            bb += std::norm(whole.data()[i]);
        }
        return std::abs(ab) / std::sqrt(aa * bb);
    };
    EXPECT_NEAR(correlation(*hologram, 0), 1, 1e-6);
    EXPECT_LT(correlation(*hologram, 1), 0.03);
    options.seed = 2;
    EXPECT_LT(correlation(*make_hologram(borrow(light_field), options), 0), 0.03);
}

// Light field that is computed on demand. Records the number of rays per read.
struct CountingSource final : LightFieldSource {
    LightFieldGrid sampled;
    mutable std::size_t max_bytes = 0, hogels = 0;

    explicit CountingSource(const LightFieldGrid& grid) : sampled(grid) {}
    const LightFieldGrid& grid() const override { return sampled; }
    bool has_depth() const override { return false; }
    HogelRange preferred_tile() const override { return {0, 0, sampled.hogels_s, 1}; }
    void read(LightFieldTile& tile) const override {
        const HogelRange& r = tile.range;
        max_bytes = std::max(max_bytes, tile.radiance.size() * sizeof(float));
        hogels += r.hogels();
        float* to = tile.radiance.data();
        for (std::size_t hogel = 0; hogel < r.hogels(); ++hogel) {
            const std::size_t number = (r.t0 + hogel / r.ns) * sampled.hogels_s + r.s0 + hogel % r.ns;
            for (std::size_t i = 0; i < sampled.directions(); ++i) *to++ = float((i * 7 + number * 31) % 64);
        }
    }
};

// A region of the hologram reads the rays of a few hogels at a time, each once, for any number of directions.
TEST(FourierHologram, reads_rays_in_bounded_batches_and_each_once) {
    const CountingSource source({16, 10, 64_um, 512, 512, Perspective{0.1, 0.1}, 1});
    ASSERT_GT(source.grid().samples() * sizeof(float), 1.2 * (1 << 27));
    for (const std::size_t looks : {1, 2}) {
        HologramOptions options;
        options.pitch = 2_um;
        options.looks = looks;
        const auto hologram = make_hologram(borrow(source), options);
        const Grid& plane = hologram->grid().plane;
        Array<Complex, 2> whole({plane.height, plane.width}), row({32, plane.width});
        source.max_bytes = source.hogels = 0;
        hologram->read({0, 0, plane.width, plane.height}, 0, whole);
        EXPECT_LE(source.max_bytes, std::size_t{1} << 27) << looks;
        EXPECT_EQ(source.hogels, source.grid().hogels()) << looks;
        for (const std::size_t t : {0, 4, 5, 9}) {
            hologram->read({0, 32 * t, plane.width, 32}, 0, row);
            const auto expected = std::span(whole.data(), whole.size()).subspan(32 * t * plane.width, row.size());
            EXPECT_TRUE(std::ranges::equal(row.elements(), expected)) << looks << " " << t;
        }
    }
}

// Photographs of a surface of uniform radiance show that radiance from all sides, without a fitted factor.
TEST(FourierHologram, a_uniform_light_field_photographs_as_its_radiance_from_every_side) {
    const LightFieldGrid grid{24, 24, 64_um, 30, 30, Perspective{0.3, 0.3}, 1};
    const LightFieldBuffer light_field = uniform(grid, 0.5f);
    HologramOptions options;
    options.pitch = 1_um;
    options.looks = 4;
    const auto hologram = make_hologram(borrow(light_field), options);
    for (const Vec3 eye : {Vec3{0, 0, 0.1}, Vec3{0.025, 0, 0.1}, Vec3{-0.01, 0.02, 0.1}}) {
        Camera camera;
        camera.eye = eye;
        camera.pupil = 5_mm;
        camera.picture = {16, 16, 64_um, 64_um, 0, 0};
        const Image image = photograph(*hologram, std::span(&camera, 1))[0];
        double mean = 0;
        for (float value : image.pixels.elements()) mean += value / 256;
        EXPECT_NEAR(mean, 0.5, 0.02) << eye.x << " " << eye.y;
    }
}

TEST(MakeHologram, names_a_pitch_that_would_do_where_one_is_too_coarse_for_the_field_of_view) {
    const LightFieldBuffer light_field = uniform(small, 1);
    HologramOptions options;
    options.pitch = 4_um;  // diffracts to asin(633/8000) = 4.5 degrees, the light field reaches 8.5
    try {
        make_hologram(borrow(light_field), options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("a pitch of 2.13"), std::string::npos) << error.what();
    }
    options.pitch = 2_um;
    options.channel.index = 1;
    EXPECT_THROW(make_hologram(borrow(light_field), options), Error);
}

// The resampling keeps constants and, away from borders, the means of linear functions.
TEST(FrequencyGrid, averages_linear_functions_exactly) {
    const LightFieldGrid grid{1, 1, 64_um, 41, 37, Perspective{0.14, 0.14}, 1};
    const double wavelength = 532_nm, step = wavelength / grid.pitch;
    const FrequencyGrid frequencies(grid, 32, wavelength);
    std::vector<float> radiance(grid.directions()), moduli(std::size_t{32} * 32);
    for (std::size_t l = 0; l < 37; ++l)
        for (std::size_t k = 0; k < 41; ++k)
            radiance[l * 41 + k] = float(1 + 3 * grid.u(double(k)) - 2 * grid.v(double(l)));
    frequencies.amplitudes(radiance, moduli);
    for (int j = -10; j <= 10; ++j)
        for (int i = -10; i <= 10; ++i) {
            const double cosine = std::sqrt(1 - (i * i + j * j) * step * step), U = -i * step / cosine,
                         V = -j * step / cosine;
            const double modulus = moduli[std::size_t((32 - j) % 32) * 32 + std::size_t((32 + i) % 32)];
            EXPECT_NEAR(modulus * modulus / (step * step / cosine), 1 + 3 * U - 2 * V, 1e-5) << i << " " << j;
        }
}

HOGEL_TEST_ON_EVERY_TARGET(LobeKernels);
HOGEL_TEST_ON_EVERY_TARGET(Transpose);

TEST_P(LobeKernels, equals_its_plain_version_for_one_hogel_and_many) {
    const LightFieldGrid grid{1, 1, 64_um, 19, 23, Perspective{0.14, 0.12}, 1};
    const FrequencyGrid frequencies(grid, 32, 532_nm);
    const std::size_t hogels = 21;
    Array<float, 2> radiances({hogels, grid.directions()}), moduli({hogels, 1024}), one({1, 1024});
    for (std::size_t i = 0; i < radiances.size(); ++i) radiances.data()[i] = float(i * 7919 % 1009) / 1009 - 0.1f;
    frequencies.amplitudes(radiances, moduli);
    for (std::size_t h = 0; h < hogels; ++h) {
        frequencies.amplitudes(radiances[h].elements(), one.elements());
        for (std::size_t i = 0; i < 1024; ++i) ASSERT_EQ(one.data()[i], moduli(h, i));
    }
    Array<float, 2> rays({grid.directions(), hogels_at_once}), plain({3, hogels_at_once}), fast({3, hogels_at_once});
    for (std::size_t i = 0; i < rays.size(); ++i) rays.data()[i] = float(i * 7919 % 1009) / 1009 - 0.1f;
    const float weights[] = {0.1f, 0.5f, 0.4f, 0.2f, 0.8f, 1.0f, 1.0f, 0.3f, 0.3f, 0.4f};
    const FrequencyGrid::Lobe lobes[] = {{5, 3, 2, 3, 2, 0, 1.5f}, {0, 18, 22, 1, 1, 5, 1}, {7, 0, 0, 1, 3, 6, 0.1f}};
    for (const bool of_roots : {false, true}) {
        average_lobes_plain(lobes, weights, rays.data(), 19, of_roots, plain.data());
        average_lobes(std::span(lobes), weights, rays.data(), 19, of_roots, fast.data());
        for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(plain.data()[i], fast.data()[i], 1e-6f) << i;
    }
}

TEST_P(Transpose, equals_its_plain_version_for_every_size) {
    std::mt19937 random(1);
    for (const auto& [rows, columns] :
         {std::pair<std::size_t, std::size_t>{16, 64}, {16, 37}, {5, 16}, {3, 3}, {41, 16}, {1, 50}, {64, 7}}) {
        const std::size_t from_row = columns + 3, to_row = rows + 2;
        std::vector<float> from(rows * from_row), plain(columns * to_row, -1), fast(columns * to_row, -1);
        for (float& value : from) value = static_cast<float>(random() % 1000);
        transpose_plain(from.data(), from_row, rows, columns, plain.data(), to_row);
        transpose(from.data(), from_row, rows, columns, fast.data(), to_row);
        EXPECT_EQ(plain, fast) << rows << "x" << columns;
        EXPECT_EQ(plain[(columns - 1) * to_row + rows - 1], from[(rows - 1) * from_row + columns - 1]);
    }
}

}  // namespace
}  // namespace hogel::stereogram
