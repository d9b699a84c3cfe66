// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/stacked.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "hogel/codec/format/stream_file.h"
#include "hogel/codec/test_damage.h"
#include "hogel/codec/test_fields.h"
#include "hogel/codec/tile_coder.h"
#include "hogel/compress.h"
#include "hogel/work/parallel.h"

namespace hogel::codec::format {
namespace {

struct Size {
    std::size_t s, t, u, v;
};

// Options for a layout, by default with tiles of odd sizes.
CompressionOptions in_layout(StreamLayout layout, std::optional<HogelRange> tile = HogelRange{0, 0, 7, 11}) {
    CompressionOptions options;
    options.target = Step{0.05};
    options.layout = layout;
    options.tile = tile;
    return options;
}

// Returns the error code that reading bytes as a stream gives.
ErrorCode outcome_of(const TestFolder& folder, const std::vector<std::uint8_t>& bytes) {
    write_bytes(folder / "b.hgl", bytes);
    return code_of([&] { decoded(folder / "b.hgl"); });
}

// Returns the light field with rows and columns exchanged, of hogels and of directions.
LightFieldBuffer transposed(const LightFieldBuffer& field) {
    LightFieldGrid grid = field.grid();
    std::swap(grid.hogels_s, grid.hogels_t);
    std::swap(grid.directions_u, grid.directions_v);
    LightFieldBuffer result(grid);
    for (std::size_t c = 0; c < grid.channels; ++c)
        for (std::size_t t = 0; t < grid.hogels_t; ++t)
            for (std::size_t s = 0; s < grid.hogels_s; ++s)
                for (std::size_t v = 0; v < grid.directions_v; ++v)
                    for (std::size_t u = 0; u < grid.directions_u; ++u)
                        result.radiance(c, t, s, v, u) = field.radiance(c, s, t, u, v);
    return result;
}

void expect_same(const LightFieldBuffer& a, const LightFieldBuffer& b) {
    for (std::size_t i = 0; i < a.radiance.size(); ++i) ASSERT_EQ(a.radiance.data()[i], b.radiance.data()[i]) << i;
}

// A light field whose rows of directions equal the rows of hogels of another one is coded as the same tiles.
TEST(Stacked, tiles_are_those_of_rows_of_directions) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(13, 19, 24, 1, 3);
    LightFieldGrid grid = field.grid();
    std::swap(grid.hogels_t, grid.directions_v);
    LightFieldBuffer flat(grid);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t t = 0; t < 19; ++t)
            for (std::size_t s = 0; s < 13; ++s)
                std::copy_n(&field.radiance(c, t, s, 0, 0), 24, &flat.radiance(c, 0, s, t, 0));
    for (const bool lossless : {false, true}) {
        CompressionOptions options = in_layout(StreamLayout::stacked, HogelRange{0, 0, 13, 19});
        CompressionOptions plain = in_layout(StreamLayout::faces, HogelRange{0, 0, 13, 1});
        if (lossless) options.target = plain.target = Lossless{};
        compress(field, folder / "a.hgl", options);
        compress(flat, folder / "b.hgl", plain);
        const StreamReader a(folder / "a.hgl"), b(folder / "b.hgl");
        // Only with loss, because the lossless coder chooses its step from other samples.
        if (!lossless) {
            EXPECT_EQ(a.read(0, a.info().layer_ends.size()), b.read(0, b.info().layer_ends.size()));
        }
        const LightFieldBuffer of_a = decoded(folder / "a.hgl"), of_b = decoded(folder / "b.hgl");
        if (lossless) {
            expect_same(of_a, field);
        }
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t t = 0; t < 19; ++t)
                for (std::size_t s = 0; s < 13; ++s)
                    for (std::size_t u = 0; u < 24; ++u)
                        ASSERT_EQ(of_a.radiance(c, t, s, 0, u), of_b.radiance(c, 0, s, t, u));
    }
}

TEST(Stacked, columns_are_stacked_as_rows_are) {
    const TestFolder folder;
    const LightFieldBuffer rows = textured_planes(13, 19, 24, 1, 1), columns = transposed(rows);
    compress(rows, folder / "a.hgl", in_layout(StreamLayout::stacked));
    compress(columns, folder / "b.hgl", in_layout(StreamLayout::stacked, HogelRange{0, 0, 11, 7}));
    expect_same(decoded(folder / "a.hgl"), transposed(decoded(folder / "b.hgl")));
    EXPECT_NEAR(double(std::filesystem::file_size(folder / "a.hgl")),
                double(std::filesystem::file_size(folder / "b.hgl")), 0);
}

// For any number of layers.
TEST(Stacked, any_range_has_the_samples_of_the_whole) {
    const TestFolder folder;
    for (const bool by_columns : {false, true}) {
        LightFieldBuffer field = textured_planes(13, 19, 24, 1, 1);
        if (by_columns) field = transposed(field);
        compress(field, folder / "a.hgl", in_layout(StreamLayout::stacked));
        const std::size_t layers = read_stream_info(folder / "a.hgl").layer_ends.size();
        ASSERT_EQ(layers, by_columns ? 5u : 4u);
        for (std::size_t layer = 1; layer <= layers; ++layer) {
            LightFieldBuffer whole(field.grid());
            copy(open_stream(folder / "a.hgl", {.layers = layer}).front(), whole);
            EXPECT_GE(sqnr_of(field, whole), layer == layers ? 25 : 5);
            const LightField source = open_stream(folder / "a.hgl", {.memory = 1, .layers = layer});
            work::parallel_for(60, [&](std::size_t i) {
                HogelRange range{i % field.grid().hogels_s, i * 7 % field.grid().hogels_t, 0, 0};
                range.ns = 1 + i % (field.grid().hogels_s - range.s0);
                range.nt = 1 + i % (field.grid().hogels_t - range.t0);
                LightFieldTile tile(field.grid(), range, false), expected = tile;
                source.front().read(tile);
                whole.read(expected);
                for (std::size_t k = 0; k < tile.radiance.size(); ++k)
                    ASSERT_EQ(tile.radiance.data()[k], expected.radiance.data()[k]);
            });
        }
    }
}

// The rows of a plane are similar; those of the other light field have different depths.
TEST(Stacked, is_chosen_where_rows_are_alike) {
    const TestFolder folder;
    LightFieldBuffer alike(LightFieldGrid{24, 24, 1e-3, 48, 1, Perspective{0.3, 0.3}, 1}), apart(alike.grid());
    for (std::size_t t = 0; t < 24; ++t)
        for (std::size_t s = 0; s < 24; ++s)
            for (std::size_t u = 0; u < 48; ++u) {
                const auto texture = [&](double x) {
                    return float(0.6 + 0.2 * std::sin(0.7 * x + 0.1 * double(t)) + 0.1 * std::sin(1.7 * x));
                };
                alike.radiance(0, t, s, 0, u) = texture(double(u) + double(s));
                apart.radiance(0, t, s, 0, u) = texture(double(u) + 0.8 * double(t * 5 % 7) * double(s));
            }
    for (const bool lossless : {false, true})
        for (const LightFieldBuffer* field : {&alike, &apart}) {
            CompressionOptions options;
            options.target = Sqnr{35};
            if (lossless) options.target = Lossless{};
            std::map<StreamLayout, std::uint64_t> bytes;
            for (const StreamLayout layout : {StreamLayout::faces, StreamLayout::stacked}) {
                options.layout = layout;
                bytes[layout] = compress(*field, folder / "a.hgl", options).bytes;
            }
            options.layout.reset();
            const CompressionResult chosen = compress(*field, folder / "a.hgl", options);
            EXPECT_LE(double(chosen.bytes),
                      1.02 * double(std::min(bytes[StreamLayout::faces], bytes[StreamLayout::stacked])));
            EXPECT_EQ(read_stream_info(folder / "a.hgl").layout,
                      field == &alike ? StreamLayout::stacked : StreamLayout::faces)
                << lossless;
        }
}

TEST(Stacked, needs_a_single_row_or_column_of_directions) {
    const auto fits = [](Size front, std::vector<Size> sides = {}) {
        std::vector<LightFieldGrid> grids{{front.s, front.t, 1e-3, front.u, front.v, Perspective{1, 1}, 1}};
        for (const Size& side : sides) grids.push_back({side.s, side.t, 1e-3, side.u, side.v, Perspective{1, 1}, 1});
        return can_stack(grids);
    };
    EXPECT_TRUE(fits({5, 4, 9, 1}));
    EXPECT_TRUE(fits({5, 4, 1, 9}));
    EXPECT_TRUE(fits({5, 4, 8, 1}, {{5, 4, 4, 1}, {5, 4, 1, 1}}));
    EXPECT_FALSE(fits({5, 4, 8, 1}, {{5, 4, 4, 2}}));
    EXPECT_FALSE(fits({5, 4, 8, 2}));
    EXPECT_FALSE(fits({5, 1, 8, 1}));
    EXPECT_FALSE(fits({1, 4, 1, 8}));
    const TestFolder folder;
    const auto refused = [&](const LightFieldBuffer& field) {
        return code_of([&] { compress(field, folder / "a.hgl", in_layout(StreamLayout::stacked)); });
    };
    EXPECT_EQ(refused(textured_planes(5, 4, 8, 2, 1)), ErrorCode::usage);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.hgl"));
}

TEST(Stacked, header_with_several_rows_of_directions_is_refused) {
    const TestFolder folder;
    compress(textured_planes(5, 9, 8, 1, 1), folder / "a.hgl", in_layout(StreamLayout::stacked));
    const std::vector<std::uint8_t> good = bytes_of_file(folder / "a.hgl");
    EXPECT_EQ(outcome_of(folder, good), ErrorCode{0});
    EXPECT_EQ(outcome_of(folder, with_number(good, 16 + 8 * 4, 2)), ErrorCode::bad_input);  // n_V
    EXPECT_EQ(outcome_of(folder, with_number(good, 16 + 8 * 2, 1)), ErrorCode::bad_input);  // T
}

// Damage is noticed even if checksums are corrected.
TEST(Stacked, every_truncation_and_every_flipped_byte_is_noticed) {
    const TestFolder folder;
    compress(textured_planes(5, 9, 8, 1, 1), folder / "a.hgl", in_layout(StreamLayout::stacked));
    const std::vector<std::uint8_t> good = bytes_of_file(folder / "a.hgl");
    for (std::size_t length = 0; length < good.size(); length += 3)
        ASSERT_EQ(outcome_of(folder, {good.begin(), good.begin() + std::ptrdiff_t(length)}), ErrorCode::bad_input)
            << length;
    for (std::size_t at = 0; at < good.size(); at += 2) {
        std::vector<std::uint8_t> bad = good;
        bad[at] = static_cast<std::uint8_t>(bad[at] ^ 1 << at % 8);
        ASSERT_EQ(outcome_of(folder, bad), ErrorCode::bad_input) << at;
    }
    const LightFieldBuffer field = textured_planes(5, 9, 8, 1, 1);
    const auto coder = coder_in_layout(StreamLayout::stacked, field.grid(),
                                       [](const LightFieldGrid& grid) { return make_tile_coder({}, grid); });
    LightFieldTile tile(field.grid(), {0, 0, 5, 9}, false);
    field.read(tile);
    LightFieldTile used = tile;
    expect_harmless_damage(*coder, coder->encode(used, 0.05).bytes, tile, 1, 1);
}

TEST(Stacked, hemisquares_with_depth_come_back) {
    const TestFolder folder;
    std::vector<LightFieldBuffer> faces;
    for (const Face face : {Face::front, Face::left, Face::right}) {
        LightFieldGrid grid = textured_planes(9, 10, face == Face::front ? 16 : 8, 1, 1).grid();
        std::get<Perspective>(grid.view).face = face;
        if (face != Face::front) grid.range().center_u = face == Face::left ? 0.5 : -0.5;
        LightFieldBuffer& field = faces.emplace_back(grid, true);
        const LightFieldBuffer textured = textured_planes(9, 10, grid.directions_u, 1, 1);
        std::ranges::copy(textured.radiance.elements(), field.radiance.elements().begin());
        for (std::size_t i = 0; i < field.depth.size(); ++i)
            field.depth.data()[i] = i % 5 == 0 ? std::numeric_limits<float>::infinity() : 1e-3f * float(i % 3);
    }
    CompressionOptions options = in_layout(StreamLayout::stacked);
    options.with_depth = true;
    options.depth_error = 1e-5;
    const std::vector<const LightFieldSource*> sources{&faces[0], &faces[1], &faces[2]};
    hogel::compress(borrow(sources), folder / "a.hgl", options);
    const LightField opened = open_stream(folder / "a.hgl");
    ASSERT_EQ(opened.faces().size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        LightFieldBuffer back(opened.faces()[k]->grid(), true);
        EXPECT_EQ(back.grid(), faces[k].grid());
        copy(*opened.faces()[k], back);
        EXPECT_GE(sqnr_of(faces[k], back), 25);
        for (std::size_t i = 0; i < back.depth.size(); ++i) {
            const float truth = faces[k].depth.data()[i];
            if (std::isfinite(truth)) {
                ASSERT_NEAR(back.depth.data()[i], truth, 1.001e-5);
            } else {
                ASSERT_EQ(back.depth.data()[i], truth);
            }
        }
    }
}

}  // namespace
}  // namespace hogel::codec::format
