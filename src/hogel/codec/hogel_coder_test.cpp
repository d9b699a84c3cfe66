// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/hogel_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/codec/encode/disparity_estimate.h"
#include "hogel/codec/format/level_syntax.h"
#include "hogel/codec/test_damage.h"
#include "hogel/codec/test_fields.h"
#include "hogel/error.h"

namespace hogel::codec {

using namespace format;

namespace {

LightFieldTile whole(const LightFieldBuffer& field) {
    LightFieldTile tile(field.grid(), {0, 0, field.grid().hogels_s, field.grid().hogels_t}, false);
    field.read(tile);
    return tile;
}

// Returns a plane at a disparity of `disparity` directions with a pattern that directions sample well.
LightFieldBuffer plane_at(double disparity, std::size_t hogels, std::size_t directions, std::size_t directions_v) {
    LightFieldGrid grid{hogels, hogels, 1e-3, directions, directions_v, Perspective{0.3, 0.25}, 1};
    LightFieldBuffer field(grid);
    const double depth = grid.pitch / grid.step_u() / disparity, period = 14 * grid.step_u() * depth;
    for (std::size_t j = 0; j < hogels; ++j)
        for (std::size_t i = 0; i < hogels; ++i)
            for (std::size_t l = 0; l < directions_v; ++l)
                for (std::size_t k = 0; k < directions; ++k) {
                    const double x = 6.28 / period * (grid.s(double(i)) + grid.u(double(k)) * depth);
                    const double y = 6.28 / period * (grid.t(double(j)) + grid.v(double(l)) * depth);
                    field.radiance(0, j, i, l, k) =
                        static_cast<float>(2 + std::sin(x + 0.3 * y) + 0.5 * std::sin(0.7 * y - 0.2 * x + 0.1 * x * y));
                }
    return field;
}

TEST(HogelOrder, has_every_hogel_once_with_references_from_earlier_wavefronts) {
    using Sides = std::pair<std::size_t, std::size_t>;
    for (const auto& [columns, rows] : {Sides{1, 1}, {2, 1}, {1, 7}, {16, 16}, {13, 32}}) {
        const HogelOrder order(columns, rows, 3, 1);
        ASSERT_EQ(order.layers(), HogelOrder::layers(columns, rows));
        const HogelOrder::Hogel& first = order.hogels().front();
        EXPECT_EQ(first.s, (columns - 1) / 2);
        EXPECT_EQ(first.t, (rows - 1) / 2);
        ASSERT_EQ(order.hogels().size(), columns * rows);
        std::vector<bool> seen(columns * rows);
        ASSERT_EQ(order.wavefronts().back(), order.hogels().size());
        for (std::size_t wavefront = 0; wavefront + 1 < order.wavefronts().size(); ++wavefront)
            for (std::size_t k = order.wavefronts()[wavefront]; k < order.wavefronts()[wavefront + 1]; ++k) {
                const HogelOrder::Hogel& hogel = order.hogels()[k];
                ASSERT_FALSE(seen[hogel.t * columns + hogel.s]);
                seen[hogel.t * columns + hogel.s] = true;
                EXPECT_EQ(hogel.references.empty(), k == 0);
                EXPECT_EQ(hogel.context_references.empty(), k == 0);
                EXPECT_LE(hogel.references.size(), 12u);
                // On each side the nearest three earlier ones are references, the nearest one is a context reference.
                const auto on_same_side = [](const HogelOrder::Reference& a, const HogelOrder::Reference& b) {
                    return a.ds * b.ds > 0 || a.dt * b.dt > 0;
                };
                for (std::size_t other = 0; other < order.wavefronts()[wavefront]; ++other) {
                    const HogelOrder::Hogel& earlier = order.hogels()[other];
                    if ((earlier.s == hogel.s) == (earlier.t == hogel.t)) continue;
                    const HogelOrder::Reference it{other, int(earlier.s) - int(hogel.s), int(earlier.t) - int(hogel.t)};
                    std::size_t nearer = 0;
                    for (std::size_t third = 0; third < order.wavefronts()[wavefront]; ++third) {
                        const HogelOrder::Hogel& h = order.hogels()[third];
                        const HogelOrder::Reference r{third, int(h.s) - int(hogel.s), int(h.t) - int(hogel.t)};
                        if ((r.ds == 0) == (r.dt == 0) || !on_same_side(r, it)) continue;
                        nearer += std::abs(r.ds + r.dt) < std::abs(it.ds + it.dt);
                    }
                    const auto among = [&](const std::vector<HogelOrder::Reference>& list) {
                        return std::ranges::count(list, other, &HogelOrder::Reference::hogel) > 0;
                    };
                    ASSERT_EQ(among(hogel.references), nearer < 3);
                    ASSERT_EQ(among(hogel.context_references), nearer < 1);
                }
                EXPECT_GE(hogel.layer, order.hogels()[k > 0 ? k - 1 : 0].layer);
                for (const HogelOrder::Reference& reference : hogel.references) {
                    ASSERT_LT(reference.hogel, order.wavefronts()[wavefront]);
                    const HogelOrder::Hogel& other = order.hogels()[reference.hogel];
                    EXPECT_EQ(std::ptrdiff_t(hogel.s) + reference.ds, std::ptrdiff_t(other.s));
                    EXPECT_EQ(std::ptrdiff_t(hogel.t) + reference.dt, std::ptrdiff_t(other.t));
                    EXPECT_TRUE(reference.ds == 0 || reference.dt == 0);
                }
            }
    }
}

TEST(Prediction, shifts_a_block_by_fractions) {
    Plane plane(32, 24);
    const auto pattern = [](double x, double y) { return std::sin(0.6 * x + 0.2) * std::cos(0.5 * y - 0.3 * x); };
    for (std::size_t y = 0; y < plane.height; ++y)
        for (std::size_t x = 0; x < plane.width; ++x)
            plane.samples[y * plane.width + x] = static_cast<float>(pattern(double(x), double(y)));
    for (const Shift shift : {Shift{0, 0}, {64, -128}, {37, 0}, {0, -21}, {-90, 75}}) {
        BlockSamples block;
        fetch_warped(plane, 8, 8, shift, block);
        for (std::size_t r = 0; r < block_side; ++r)
            for (std::size_t c = 0; c < block_side; ++c)
                ASSERT_NEAR(block[r * block_side + c],
                            pattern(8 + double(c) + shift.u / 64.0, 8 + double(r) + shift.v / 64.0), 0.01)
                    << shift.u << " " << shift.v;
    }
    // Beyond its borders a plane repeats its outermost samples.
    BlockSamples block;
    fetch_warped(plane, 24, 16, {64 * 1000, 64 * 1000}, block);
    for (const float value : block) EXPECT_NEAR(value, plane.samples.back(), 1e-6);
}

TEST(Prediction, estimates_the_disparity_of_a_plane) {
    for (const double disparity : {0.4, -0.8, 1.55}) {
        LightFieldTile tile = whole(plane_at(disparity, 9, 64, 48));
        const LightFieldGrid grid = plane_at(disparity, 9, 64, 48).grid();
        const TileSetup setup(HogelOrder(9, 9, 3, 1), 64, 48, 1, 0.01f, 1.35f,
                              static_cast<float>(grid.step_u() / grid.step_v()));
        for (const HogelOrder::Hogel& hogel : setup.order.hogels()) {
            if (hogel.layer > 0) break;
            std::vector<std::int16_t> estimated = encode::estimate_disparities(setup, tile, hogel).disparities;
            std::ranges::nth_element(estimated, estimated.begin() + std::ptrdiff_t(estimated.size() / 2));
            EXPECT_NEAR(estimated[estimated.size() / 2] / 64.0, disparity, 0.04) << disparity;
        }
    }
}

TEST(Prediction, intra_predictors_continue_directions) {
    struct Along {
        int predictor;
        double u, v;  // the direction
    };
    for (const Along along : {Along{4, -1, 1}, {5, -0.5, 1}, {6, 0.5, 1}, {7, 1, 1}, {8, 1, 0.5}, {9, 1, -0.5}}) {
        Plane plane(32, 24);
        for (std::size_t y = 0; y < plane.height; ++y)
            for (std::size_t x = 0; x < plane.width; ++x)
                plane.samples[y * plane.width + x] = static_cast<float>(along.v * double(x) - along.u * double(y));
        BlockSamples block;
        predict_intra(plane, 8, 8, along.predictor, block);
        for (std::size_t r = 0; r < block_side; ++r)
            for (std::size_t c = 0; c < block_side; ++c) {
                // Samples below the block are not known.
                if (along.u > 0 && along.v < 0 && double(r) + 0.5 * double(c + 1) > 7) continue;
                ASSERT_FLOAT_EQ(block[r * block_side + c], plane.samples[(8 + r) * plane.width + 8 + c])
                    << along.predictor << " " << r << " " << c;
            }
    }
}

// For every basis, the transform acts only along the axes on which it has cosines.
TEST(Blocks, transform_is_the_orthonormal_cosine_transform) {
    BlockSamples block, coefficients, back;
    for (std::size_t k = 0; k < block_samples; ++k) block[k] = static_cast<float>(std::sin(double(k * k)));
    for (const Basis basis : bases) {
        transform_block(basis, block, coefficients);
        inverse_transform_block(basis, coefficients, back);
        double energy = 0, energy_after = 0;
        for (std::size_t k = 0; k < block_samples; ++k) {
            EXPECT_NEAR(back[k], block[k], 2e-5);
            energy += double(block[k]) * block[k];
            energy_after += double(coefficients[k]) * coefficients[k];
        }
        EXPECT_NEAR(energy_after, energy, 1e-4 * energy);
        // The first coefficient is √8 times the mean along each axis with cosines.
        double sum = 0;
        const std::size_t columns = basis.cosines_u ? block_side : 1, rows = basis.cosines_v ? block_side : 1;
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < columns; ++c) sum += block[r * block_side + c];
        EXPECT_NEAR(coefficients[0], sum / std::sqrt(double(columns * rows)), 1e-5);
    }
}

// A single sample takes one level in a basis of samples, but most levels of a block in one of cosines.
TEST(HogelCoder, single_samples_and_lines_take_few_bits) {
    constexpr std::size_t side = 256;
    LightFieldBuffer field({1, 1, 1e-3, side, side, Perspective{0.3, 0.3}, 1});
    const auto bits_of_a_block = [&](auto&& value) {
        for (std::size_t v = 0; v < side; ++v)
            for (std::size_t u = 0; u < side; ++u) field.radiance(0, 0, 0, v, u) = value(v, u);
        LightFieldTile tile = whole(field);
        const double bytes = double(make_hogel_coder(field.grid())->encode(tile, 0.1).bytes.size());
        return 8 * bytes / (side * side / block_samples);
    };
    const auto place = [](std::size_t at, std::uint32_t seed) {
        return 1 + core::philox({static_cast<std::uint32_t>(at / block_side), seed, 0, 0}, {7, 8})[0] % 6;
    };
    // One sample in each block; a vertical line through all blocks of a column; a horizontal line through all blocks of
    // a row.
    EXPECT_LT(bits_of_a_block([&](std::size_t v, std::size_t u) {
                  const std::size_t block = v / block_side * side + u;
                  return v % block_side == place(block, 1) && u % block_side == place(block, 2) ? 1.0f : 0.0f;
              }),
              30);
    EXPECT_LT(bits_of_a_block([&](std::size_t, std::size_t u) { return u % block_side == place(u, 3) ? 1.0f : 0.0f; }),
              30);
    EXPECT_LT(bits_of_a_block([&](std::size_t v, std::size_t) { return v % block_side == place(v, 4) ? 1.0f : 0.0f; }),
              30);
}

TEST(Blocks, levels_of_all_bases_come_back) {
    std::vector<Levels> given;
    std::vector<std::uint8_t> basis;
    for (std::uint32_t n = 0; n < 400; ++n) {
        Levels levels{};
        const std::uint32_t filled = 1 + n % block_samples;
        for (std::uint32_t k = 0; k < filled; ++k) {
            const auto random = core::philox({n, k, 0, 0}, {3, 4});
            levels[random[0] % block_samples] = static_cast<std::int32_t>(random[1]) >> (8 + random[2] % 24);
        }
        levels[n % block_samples] = n % 2 == 0 ? 1 : -1;  // at least one
        given.push_back(levels);
        basis.push_back(static_cast<std::uint8_t>(n / 3 % bases.size()));
    }
    const auto code_all = [&](auto& coder, auto&& use) {
        BlockModels models;
        for (std::size_t n = 0; n < given.size(); ++n) use(coder, models.levels[0][n % 2], models.basis[0][n % 4], n);
    };
    BlockWriter writer;
    code_all(writer, [&](BlockWriter& coder, auto& models, auto& of_basis, std::size_t n) {
        code_basis(coder, of_basis, basis[n]);
        code_levels(coder, models, bases[basis[n]], given[n]);
    });
    const std::vector<std::uint8_t> bytes = writer.finish();
    BlockReader reader(bytes);
    code_all(reader, [&](BlockReader& coder, auto& models, auto& of_basis, std::size_t n) {
        Levels found{};
        ASSERT_EQ(code_basis(coder, of_basis, 0), basis[n]);
        code_levels(coder, models, bases[basis[n]], found);
        ASSERT_EQ(found, given[n]) << n;
    });
    EXPECT_TRUE(reader.all_read());
    EXPECT_FALSE(reader.ended());
}

TEST(HogelCoder, a_plane_seen_by_64_hogels_takes_few_more_bytes_than_by_one) {
    const LightFieldBuffer field = plane_at(0.6, 8, 96, 64);
    const auto coder = make_hogel_coder(field.grid());
    LightFieldTile one(field.grid(), {0, 0, 1, 1}, false);
    field.read(one);
    const double step = 0.02;
    LightFieldTile many = whole(field);
    const auto alone = coder->encode(one, step), all = coder->encode(many, step);
    EXPECT_LT(double(all.bytes.size()), 6 * double(alone.bytes.size()));
    EXPECT_LT(all.squared_error / 64, 2 * (alone.squared_error + 96 * 64 * step * step / 12));
}

// Includes hogels of whole blocks, which are reconstructed in place in the tile.
TEST(HogelCoder, returns_the_error_that_decoding_gives) {
    for (const auto& [width, height, channels] :
         {std::array<std::size_t, 3>{21, 19, 3}, {24, 16, 3}, {24, 16, 1}, {17, 8, 1}}) {
        const LightFieldBuffer field = textured_planes(6, 5, width, height, channels);
        const auto coder = make_hogel_coder(field.grid());
        const LightFieldTile tile = whole(field);
        LightFieldTile used_up = tile;
        const auto encoded = coder->encode(used_up, 0.05);
        LightFieldTile decoded(field.grid(), tile.range, false);
        coder->decode(encoded.bytes, decoded);
        double error = 0;
        for (std::size_t i = 0; i < tile.radiance.size(); ++i) {
            const double d = double(tile.radiance.data()[i]) - decoded.radiance.data()[i];
            error += d * d;
        }
        EXPECT_NEAR(encoded.squared_error, error, 1e-9 * error) << width << " " << channels;
        EXPECT_GT(error, 0);
    }
}

// Decoding gives a tile or throws Error(bad_input).
TEST(HogelCoder, damaged_bytes_do_no_harm) {
    const LightFieldBuffer field = textured_planes(5, 4, 20, 12, 1);
    const auto coder = make_hogel_coder(field.grid());
    LightFieldTile tile = whole(field);
    const std::vector<std::uint8_t> good = coder->encode(tile, 0.05).bytes;
    expect_harmless_damage(*coder, good, tile, 1, 1);
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        std::vector<std::uint8_t> noise(good.begin(), good.begin() + 8);
        for (std::uint32_t i = 0; i < 1000; ++i)
            noise.push_back(static_cast<std::uint8_t>(core::philox({i, seed, 0, 0}, {5, 6})[0]));
        refuses(*coder, noise, tile);
    }
}

TEST(HogelCoder, tiles_that_are_too_large_are_refused) {
    const LightFieldGrid grid{65, 1, 1e-3, 4, 4, Perspective{0.3, 0.3}, 1};
    const auto coder = make_hogel_coder(grid);
    LightFieldTile tile(grid, {0, 0, 65, 1}, false);
    EXPECT_THROW(coder->encode(tile, 0.1), Error);
    EXPECT_LE(coder->preferred_tile(grid).ns, 33u);
    // Tiles of a large light field that are within the limits.
    const LightFieldGrid large{128, 128, 1e-3, 512, 512, Perspective{0.3, 0.3}, 3};
    const HogelRange preferred = coder->preferred_tile(large);
    EXPECT_LE(double(preferred.hogels()) * 512 * 512 * 3, 0x1p27);
    EXPECT_GE(preferred.ns, 12u);
}

}  // namespace
}  // namespace hogel::codec
