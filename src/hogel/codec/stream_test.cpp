// SPDX-License-Identifier: Apache-2.0
#include "hogel/compress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>

#include "hogel/codec/format/bytes.h"
#include "hogel/codec/test_damage.h"
#include "hogel/codec/test_fields.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::codec {
namespace {

CompressionOptions small_tiles(const char* coder, const char* transform) {
    CompressionOptions options;
    options.method = {coder, transform};
    options.target = Step{0.02};
    options.tile = HogelRange{0, 0, 3, 2};
    options.metadata = {{"what", "a test"}, {"", "Ελλάδα"}};
    return options;
}

TEST(Stream, checksum_is_that_of_png) {
    const std::string text = "123456789";
    EXPECT_EQ(core::checksum({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}), 0xCBF43926u);
}

TEST(Stream, header_comes_back) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(7, 5, 8, 6, 3);
    compress(field, folder / "a.hgl", small_tiles("ezw", "haar"));
    EXPECT_TRUE(is_stream(folder / "a.hgl"));
    const StreamInfo info = read_stream_info(folder / "a.hgl");
    EXPECT_EQ(info.grid, field.grid());
    EXPECT_EQ(info.tile, (HogelRange{0, 0, 3, 2}));
    EXPECT_EQ(info.method, (CodingMethod{"ezw", "haar"}));
    EXPECT_EQ(info.metadata, (Metadata{{"what", "a test"}, {"", "Ελλάδα"}}));
}

// Read from several threads, with memory for one tile and for all.
TEST(Stream, any_range_has_the_samples_of_the_whole) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(7, 5, 8, 6, 3);
    compress(field, folder / "a.hgl", small_tiles("threepass", "cdf97"));
    LightFieldBuffer whole(field.grid());
    copy(open_stream(folder / "a.hgl").front(), whole);
    for (const std::size_t memory : {std::size_t{1}, std::size_t{5000}, std::size_t{1} << 30}) {
        const LightField source = open_stream(folder / "a.hgl", {.memory = memory});
        work::parallel_for(200, [&](std::size_t i) {
            HogelRange range{i % 7, i / 7 % 5, 0, 0};
            range.ns = 1 + i % (7 - range.s0);
            range.nt = 1 + i % (5 - range.t0);
            LightFieldTile tile(field.grid(), range, false), expected = tile;
            source.front().read(tile);
            whole.read(expected);
            for (std::size_t k = 0; k < tile.radiance.size(); ++k)
                ASSERT_EQ(tile.radiance.data()[k], expected.radiance.data()[k]);
        });
    }
}

// Includes directions off centre.
TEST(Stream, keeps_the_grid) {
    const TestFolder folder;
    LightFieldGrid grid{3, 2, 1e-3, 4, 5, Perspective{0.5, 0.7}, 1};
    grid.range().center_u = 0.5;
    grid.range().center_v = -0.75;
    compress(LightFieldBuffer(grid), folder / "a.hgl", small_tiles("threepass", "haar"));
    EXPECT_TRUE(open_stream(folder / "a.hgl").grid() == grid);
}

// With and without depth, whose stream has the same directions.
TEST(Stream, keeps_a_fixed_focal_plane_and_frequencies) {
    const TestFolder folder;
    LightFieldGrid grid{3, 2, 1e-3, 4, 5, FocalPlane{{0.5, 0.7, 0.1, -0.2}, -0.3}, 1};
    for (const bool frequencies : {false, true})
        for (const bool depth : {false, true}) {
            if (frequencies) grid.view = Frequencies{grid.range()};
            const LightFieldBuffer field(grid, true);
            CompressionOptions options = small_tiles("threepass", "haar");
            options.with_depth = depth;
            compress(field, folder / "a.hgl", options);
            const LightField back = open_stream(folder / "a.hgl");
            EXPECT_TRUE(back.grid() == grid);
            EXPECT_EQ(back.has_depth(), depth);
        }
}

// By every coder.
TEST(Stream, of_frequencies_has_the_quality_asked_for) {
    const TestFolder folder;
    LightFieldBuffer field = textured_planes(4, 3, 8, 8, 1);
    LightFieldGrid grid = field.grid();
    grid.view = Frequencies{{0.3, 0.2, 0.1, -0.05}};
    LightFieldBuffer sines(grid);
    std::ranges::copy(field.radiance.elements(), sines.radiance.elements().begin());
    for (const char* coder : {"hogel", "threepass", "ezw", "jpeg4d", "fringes"}) {
        CompressionOptions options;
        options.method.coder = coder;
        options.target = Sqnr{40};
        compress(sines, folder / "a.hgl", options);
        const LightField back = open_stream(folder / "a.hgl");
        EXPECT_TRUE(back.grid() == grid) << coder;
        LightFieldBuffer decoded(grid);
        copy(back.front(), decoded);
        double energy = 0, error = 0;
        for (std::size_t i = 0; i < sines.radiance.size(); ++i) {
            const double value = sines.radiance.data()[i], off = value - decoded.radiance.data()[i];
            energy += value * value;
            error += off * off;
        }
        EXPECT_LE(error, 1.1e-4 * energy) << coder;
    }
}

// Returns the error that reading a file throws, if any.
std::optional<ErrorCode> outcome(const std::filesystem::path& path) {
    try {
        const LightField source = open_stream(path);
        LightFieldBuffer field(source.front().grid());
        copy(source.front(), field);
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.code();
    }
    return std::nullopt;
}

TEST(Stream, every_truncation_and_every_flipped_byte_is_noticed) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(4, 3, 4, 4, 1);
    compress(field, folder / "a.hgl", small_tiles("threepass", "ai13"));
    const std::vector<std::uint8_t> good = bytes_of_file(folder / "a.hgl");
    ASSERT_EQ(outcome(folder / "a.hgl"), std::nullopt);
    for (std::size_t length = 0; length < good.size(); length += length % 32 < 2 ? 1 : 6) {
        write_bytes(folder / "b.hgl", {good.begin(), good.begin() + std::ptrdiff_t(length)});
        ASSERT_EQ(outcome(folder / "b.hgl"), ErrorCode::bad_input) << "cut at " << length;
    }
    for (std::size_t at = 0; at < good.size(); ++at) {
        std::vector<std::uint8_t> bad = good;
        bad[at] = static_cast<std::uint8_t>(bad[at] ^ 1 << at % 8);
        write_bytes(folder / "b.hgl", bad);
        ASSERT_EQ(outcome(folder / "b.hgl"), ErrorCode::bad_input) << "byte " << at;
    }
    std::vector<std::uint8_t> longer = good;
    longer.push_back(0);
    write_bytes(folder / "b.hgl", longer);
    EXPECT_EQ(outcome(folder / "b.hgl"), ErrorCode::bad_input);
}

// A truncated file is refused if more layers are requested than it has.
TEST(Stream, beginning_of_a_file_is_a_coarser_light_field) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(9, 5, 24, 16, 1);
    for (const bool lossless : {false, true}) {
        CompressionOptions options;
        options.target = Step{0.02};
        if (lossless) options.target = Lossless{};
        options.tile = HogelRange{0, 0, 5, 5};
        compress(field, folder / "a.hgl", options);
        const std::vector<std::uint8_t> good = bytes_of_file(folder / "a.hgl");
        const StreamInfo info = read_stream_info(folder / "a.hgl");
        const std::size_t layers = info.layer_ends.size();
        ASSERT_EQ(layers, lossless ? 4u : 3u);
        EXPECT_EQ(info.layers_there, layers);
        EXPECT_EQ(info.layer_ends.back(), good.size());
        double before = 0;
        for (std::size_t layer = 1; layer <= layers; ++layer) {
            const std::uint64_t end = info.layer_ends[layer - 1];
            for (const std::uint64_t length : {end, end + 1}) {
                if (length > good.size()) continue;
                write_bytes(folder / "b.hgl", {good.begin(), good.begin() + std::ptrdiff_t(length)});
                EXPECT_EQ(read_stream_info(folder / "b.hgl").layers_there, layer);
                LightFieldBuffer coarse(field.grid());
                copy(open_stream(folder / "b.hgl", {.layers = layer}).front(), coarse);
                const double sqnr = sqnr_of(field, coarse);
                EXPECT_GT(sqnr, length == end ? before : before - 1e-9);
                before = sqnr;
                if (layer < layers) {
                    EXPECT_THROW(open_stream(folder / "b.hgl"), Error);
                    EXPECT_THROW(open_stream(folder / "b.hgl", {.layers = layer + 1}), Error);
                }
            }
        }
        EXPECT_THROW(open_stream(folder / "a.hgl", {.layers = layers + 1}), Error);
        write_bytes(folder / "b.hgl", {good.begin(), good.begin() + std::ptrdiff_t(info.layer_ends[0] - 1)});
        EXPECT_THROW(read_stream_info(folder / "b.hgl"), Error);
    }
}

// The header has a valid checksum. It must not make the reader allocate memory for impossible sizes.
TEST(Stream, forged_header_does_no_harm) {
    const TestFolder folder;
    compress(textured_planes(4, 3, 4, 4, 1), folder / "a.hgl", small_tiles("threepass", "ai13"));
    const std::vector<std::uint8_t> good = bytes_of_file(folder / "a.hgl");
    const auto forged = [&](std::size_t field, std::uint64_t value) {
        write_bytes(folder / "b.hgl", with_number(good, 16 + 8 * field, value));
        return outcome(folder / "b.hgl");
    };
    EXPECT_EQ(forged(0, 1), std::nullopt);  // the true value
    for (std::size_t field = 0; field < 10; ++field)
        for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{1} << 40, ~std::uint64_t{0},
                                          std::uint64_t{0x7FF} << 52}) {
            const auto code = forged(field, value);
            EXPECT_TRUE(!code || code == ErrorCode::bad_input) << field;
        }
    EXPECT_EQ(forged(1, std::uint64_t{1} << 40), ErrorCode::bad_input);
}

TEST(Stream, other_versions_and_other_files_are_refused_by_name) {
    const TestFolder folder;
    compress(textured_planes(2, 2, 4, 4, 1), folder / "a.hgl", small_tiles("threepass", "ai13"));
    std::vector<std::uint8_t> bytes = bytes_of_file(folder / "a.hgl");
    bytes[8] = 9;
    write_bytes(folder / "b.hgl", bytes);
    try {
        open_stream(folder / "b.hgl");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("version 9"), std::string::npos);
    }
    write_bytes(folder / "c.hgl", {'P', 'N', 'G'});
    EXPECT_FALSE(is_stream(folder / "c.hgl"));
    EXPECT_EQ(outcome(folder / "c.hgl"), ErrorCode::bad_input);
}

// Depths near two values and infinite ones, in an incoherent pattern.
LightFieldBuffer with_depth(std::size_t hogels) {
    const LightFieldBuffer textured = textured_planes(hogels, 3, 11, 9, 3);
    LightFieldBuffer field(textured.grid(), true);
    std::ranges::copy(textured.radiance.elements(), field.radiance.elements().begin());
    std::size_t i = 0;
    for (float& depth : field.depth.elements()) {
        const float places[] = {std::numeric_limits<float>::infinity(), -2e-3f, 5e-3f};
        depth = places[i * i / 7 % 3] + 1e-3f * float(i % 17);
        ++i;
    }
    return field;
}

TEST(Stream, keeps_depth_within_an_error_and_infinity_as_it_is) {
    const TestFolder folder;
    const LightFieldBuffer field = with_depth(5);
    CompressionOptions options;
    options.target = Sqnr{25};
    options.tile = HogelRange{0, 0, 3, 2};
    options.with_depth = true;
    for (const std::optional<double> error :
         {std::optional<double>(), std::optional(0.0), std::optional(1e-4), std::optional(1e-7)}) {
        options.depth_error = error;
        const CompressionResult result = compress(field, folder / "d.hgl", options);
        EXPECT_EQ(result.depth_error, error.value_or(default_depth_error(field.grid(), 23e-3)));
        EXPECT_EQ(read_stream_info(folder / "d.hgl").depth.error, result.depth_error);
        EXPECT_EQ(result.bytes, std::filesystem::file_size(folder / "d.hgl"));
        LightFieldBuffer decoded(field.grid(), true);
        copy(open_stream(folder / "d.hgl").front(), decoded);
        EXPECT_GE(sqnr_of(field, decoded), 25);
        std::size_t finite = 0;
        for (std::size_t i = 0; i < field.depth.size(); ++i) {
            const float truth = field.depth.data()[i], found = decoded.depth.data()[i];
            if (!std::isfinite(truth)) {
                ASSERT_EQ(found, truth);
                continue;
            }
            ++finite;
            ASSERT_NEAR(found, truth, result.depth_error > 0 ? result.depth_error * (1 + 1e-6) + 1e-9 : 0);
        }
        EXPECT_GT(finite, field.depth.size() / 2);
    }
    // Reads a part of the light field, and one whose depths are all infinite.
    LightFieldTile part(field.grid(), {1, 1, 3, 2}, true), same(field.grid(), {1, 1, 3, 2}, true);
    open_stream(folder / "d.hgl").front().read(part);
    field.read(same);
    for (std::size_t i = 0; i < part.depth.size(); ++i)
        if (std::isfinite(same.depth.data()[i])) {
            ASSERT_NEAR(part.depth.data()[i], same.depth.data()[i], 2e-7);
        }
    LightFieldBuffer empty(field.grid(), true);
    std::ranges::fill(empty.depth.elements(), std::numeric_limits<float>::infinity());
    compress(empty, folder / "e.hgl", options);
    LightFieldBuffer decoded(field.grid(), true);
    copy(open_stream(folder / "e.hgl").front(), decoded);
    for (const float depth : decoded.depth.elements()) ASSERT_EQ(depth, std::numeric_limits<float>::infinity());
    EXPECT_THROW(compress(textured_planes(3, 3, 5, 5, 1), folder / "no.hgl", options), Error);
    empty.depth(0, 0, 0, 0) = std::nanf("");
    EXPECT_THROW(compress(empty, folder / "no.hgl", options), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "no.hgl"));
}

TEST(Stream, lossless_keeps_every_array_bit_for_bit) {
    const TestFolder folder;
    LightFieldBuffer field = with_depth(5);
    field.depth(1, 2, 3, 4) = -0.0f;
    field.depth(1, 2, 3, 5) = 1e-30f;
    CompressionOptions options;
    options.target = Lossless{};
    options.with_depth = true;
    EXPECT_EQ(compress(field, folder / "l.hgl", options).depth_error, 0);
    LightFieldBuffer decoded(field.grid(), true);
    copy(open_stream(folder / "l.hgl").front(), decoded);
    const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
    };
    EXPECT_TRUE(same(field.radiance, decoded.radiance));
    EXPECT_TRUE(same(field.depth, decoded.depth));
}

// The bound moves the point of the steepest ray by a 32,000th of a hogel, and is no coarser than the range allows.
TEST(Stream, the_default_error_of_depth_is_that_of_the_steepest_ray) {
    LightFieldGrid grid{4, 4, 50e-6, 9, 9, Perspective{0.1, 0.2}, 1};
    EXPECT_DOUBLE_EQ(default_depth_error(grid, 1), 50e-6 / 32000 / 0.2);
    grid.range().center_u = 0.4;
    EXPECT_DOUBLE_EQ(default_depth_error(grid, 1), 50e-6 / 32000 / 0.5);
    EXPECT_DOUBLE_EQ(default_depth_error(grid, 1e-6), 1e-9);
    // With a fixed focal plane the hogels at the edge have the steepest: those at 75 µm see up to 0.5 + 75 µm/1 mm.
    grid.view = FocalPlane{grid.range(), 1e-3};
    EXPECT_DOUBLE_EQ(default_depth_error(grid, 1), 50e-6 / 32000 / 0.575);
    // The steepest ray has the sines (0.75, 0.5); (0.75, 0.75) belongs to none.
    grid.directions_u = grid.directions_v = 7;
    grid.view = Frequencies{{0.875, 0.875}};
    EXPECT_NEAR(default_depth_error(grid, 1), 50e-6 / 32000 / (0.75 / std::sqrt(1 - 0.5625 - 0.25)), 1e-15);
}

// Layers of the radiance alone can be read without the depth stream.
TEST(Stream, truncated_or_damaged_depth_is_noticed) {
    const TestFolder folder;
    const LightFieldBuffer field = with_depth(2);
    CompressionOptions options;
    options.target = Sqnr{20};
    options.with_depth = true;
    options.depth_error = 1e-3;
    const CompressionResult result = compress(field, folder / "good.hgl", options);
    const std::vector<std::uint8_t> good = bytes_of_file(folder / "good.hgl");
    const std::size_t depth_begins = good.size() - result.depth_bytes;
    const std::size_t layers = read_stream_info(folder / "good.hgl").layer_ends.size();
    const auto decodes = [&](const std::vector<std::uint8_t>& bytes, std::size_t wanted) {
        write_bytes(folder / "bad.hgl", bytes);
        try {
            const LightField source = open_stream(folder / "bad.hgl", {.layers = wanted});
            LightFieldTile tile(field.grid(), {0, 0, 2, 3}, source.front().has_depth());
            source.front().read(tile);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
            return false;
        }
        return true;
    };
    EXPECT_TRUE(decodes(good, 0));
    for (std::size_t length = depth_begins; length < good.size(); length += 7) {
        const std::vector<std::uint8_t> cut(good.begin(), good.begin() + std::ptrdiff_t(length));
        ASSERT_FALSE(decodes(cut, 0)) << length;
        ASSERT_TRUE(decodes(cut, layers)) << length;
        ASSERT_FALSE(open_stream(folder / "bad.hgl", {.layers = layers}).has_depth());
    }
    for (std::size_t at = 0; at < good.size(); at += 3) {
        std::vector<std::uint8_t> bad = good;
        bad[at] = static_cast<std::uint8_t>(bad[at] ^ 1 << at % 8);
        ASSERT_FALSE(decodes(bad, 0)) << at;
    }
    std::vector<std::uint8_t> longer = good;
    longer.push_back(0);
    EXPECT_FALSE(decodes(longer, 0));
    // The header ends with the bytes of depth, their error, and the value that means infinity.
    const std::size_t end = end_of_header(good);
    EXPECT_TRUE(decodes(with_number(good, end - 24, result.depth_bytes), 0));
    for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 40, ~std::uint64_t{0}})
        EXPECT_FALSE(decodes(with_number(good, end - 24, bytes), 0)) << bytes;
    EXPECT_FALSE(decodes(with_number(good, end - 8, std::uint64_t{0x7FF} << 52), 0));
}

}  // namespace
}  // namespace hogel::codec
