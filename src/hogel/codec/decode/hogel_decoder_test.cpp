// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/decode/hogel_decoder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hogel/codec/format/model_states.h"
#include "hogel/codec/hogel_coder.h"
#include "hogel/codec/test_damage.h"
#include "hogel/codec/test_fields.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::codec::decode {

using namespace format;

namespace {

struct Example {
    LightFieldBuffer field;
    HogelRange whole;
    TileCoder::Encoded encoded;
    LightFieldTile decoded;

    Example(std::size_t s, std::size_t t, std::size_t u, std::size_t v, std::size_t channels, double step = 0.02)
        : Example(textured_planes(s, t, u, v, channels), step) {}
    Example(LightFieldBuffer shown, double step)
        : field(std::move(shown)),
          whole{0, 0, field.grid().hogels_s, field.grid().hogels_t},
          decoded(field.grid(), whole, false) {
        const auto coder = make_hogel_coder(field.grid());
        LightFieldTile tile(field.grid(), whole, false);
        field.read(tile);
        encoded = coder->encode(tile, step);
        coder->decode(encoded.bytes, decoded);
    }
    HogelDecoder open() const { return open(encoded.layers.size()); }
    HogelDecoder open(std::size_t layers) const {
        const auto end = encoded.bytes.begin() + std::ptrdiff_t(encoded.layers[layers - 1]);
        return {{encoded.bytes.begin(), end}, field.grid(), whole, layers};
    }
    // Returns whether a part has the samples of the whole.
    bool has(const LightFieldTile& part) const {
        LightFieldTile expected(field.grid(), part.range, false);
        copy_common(decoded, expected);
        return std::ranges::equal(part.radiance.elements(), expected.radiance.elements());
    }
};

TEST(HogelDecoder, any_part_has_the_samples_of_the_whole) {
    for (const Example& example :
         {Example(9, 7, 40, 33, 1), Example(5, 6, 27, 30, 3), Example(1, 9, 16, 8, 1), Example(12, 1, 64, 3, 1)}) {
        const HogelRange& whole = example.whole;
        for (std::size_t k = 0; k < whole.hogels(); ++k) {
            HogelRange range{k % whole.ns, k / whole.ns, 1, 1};
            HogelDecoder decoder = example.open();
            for (int more = 0; more < 2; ++more) {  // a second reading of the same tile decodes more of it
                LightFieldTile part(example.field.grid(), range, false);
                decoder.read(part);
                ASSERT_TRUE(example.has(part)) << range.s0 << " " << range.t0;
                range.ns = std::min<std::size_t>(3, whole.ns - range.s0);
                range.nt = std::min<std::size_t>(2, whole.nt - range.t0);
            }
        }
    }
}

// The first hogel has lines from the upper right, which intra prediction continues. The other hogels see them shifted
// by more than a block, so that they need only one end of the first hogel.
TEST(HogelDecoder, a_part_of_intra_blocks_gets_the_samples_above_on_the_right) {
    LightFieldBuffer field({5, 1, 1e-3, 64, 40, Perspective{0.3, 0.3}, 1});
    for (std::size_t s = 0; s < 5; ++s)
        for (std::size_t v = 0; v < 40; ++v)
            for (std::size_t u = 0; u < 64; ++u) {
                const auto line = static_cast<std::uint32_t>(u + v + 12 * s);
                field.radiance(0, 0, s, v, u) = static_cast<float>(core::philox({line, 0, 0, 0}, {1, 2})[0]) * 0x1p-32f;
            }
    const Example example(std::move(field), 0.05);
    for (std::size_t s = 0; s < 5; ++s) {
        HogelDecoder decoder = example.open();
        LightFieldTile part(example.field.grid(), {s, 0, 1, 1}, false);
        decoder.read(part);
        ASSERT_TRUE(example.has(part)) << s;
    }
}

// Decoding one hogel reads a few hogels of each layer, not the whole tile.
TEST(HogelDecoder, a_hogel_needs_few_others) {
    const Example example(32, 32, 16, 16, 1);
    std::size_t max_read = 0, all_blocks = 0;
    for (std::size_t k = 7; k < 1024; k += 61) {
        HogelDecoder decoder = example.open();
        EXPECT_EQ(decoder.hogels_read(), 0u);
        LightFieldTile part(example.field.grid(), {k % 32, k / 32, 1, 1}, false);
        decoder.read(part);
        ASSERT_TRUE(example.has(part));
        max_read = std::max(max_read, decoder.hogels_read());
        all_blocks += decoder.blocks_reconstructed();
        const std::size_t blocks = decoder.blocks_reconstructed();
        decoder.read(part);
        EXPECT_EQ(decoder.blocks_reconstructed(), blocks);  // no block is reconstructed twice
    }
    EXPECT_GE(max_read, 10u);
    EXPECT_LE(max_read, 160u);
    EXPECT_LE(all_blocks, 17 * 4 * 80u);  // of 4 · 1024 each
}

TEST(HogelDecoder, several_threads_read_the_same_tile) {
    const Example example(9, 8, 24, 24, 1);
    for (const std::size_t threads : {1, 4}) {
        const ThreadLimit limit(threads);
        HogelDecoder decoder = example.open();
        work::parallel_for(200, [&](std::size_t i) {
            HogelRange range{i % 9, i / 9 % 8, 1, 1};
            range.ns = 1 + i % (9 - range.s0);
            LightFieldTile part(example.field.grid(), range, false);
            decoder.read(part);
            EXPECT_TRUE(example.has(part));
        });
    }
}

TEST(HogelDecoder, each_layer_reduces_the_error) {
    const Example example(9, 9, 48, 40, 3);
    ASSERT_EQ(example.encoded.layers.size(), 4u);
    double before = 0;
    for (std::size_t layers = 1; layers <= 4; ++layers) {
        LightFieldTile tile(example.field.grid(), example.whole, false);
        HogelDecoder decoder = example.open(layers);
        decoder.read(tile);
        LightFieldBuffer other(example.field.grid());
        other.write(tile);
        const double sqnr = sqnr_of(example.field, other);
        EXPECT_GT(sqnr, before + 0.2) << layers;
        before = sqnr;
        LightFieldTile part(example.field.grid(), {4, 3, 1, 1}, false), expected = part;
        HogelDecoder partial = example.open(layers);
        partial.read(part);
        copy_common(tile, expected);
        EXPECT_TRUE(std::ranges::equal(part.radiance.elements(), expected.radiance.elements()));
    }
    EXPECT_GT(before, 25);
}

// Reading gives other samples or throws Error(bad_input).
TEST(HogelDecoder, damaged_bytes_do_no_harm) {
    const Example example(5, 5, 16, 16, 1);
    std::size_t refused = 0;
    const auto attempt = [&](std::vector<std::uint8_t> bytes, std::size_t layers) {
        try {
            HogelDecoder decoder(std::move(bytes), example.field.grid(), example.whole, layers);
            LightFieldTile part(example.field.grid(), {3, 1, 1, 2}, false);
            decoder.read(part);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
            ++refused;
        }
    };
    const auto& good = example.encoded.bytes;
    for (std::size_t at = 0; at < good.size(); ++at) {
        std::vector<std::uint8_t> bad = good;
        bad[at] = static_cast<std::uint8_t>(bad[at] ^ 1 << at % 8);
        attempt(bad, example.encoded.layers.size());
    }
    EXPECT_GT(refused, 20u);
    refused = 0;
    for (std::size_t length = 0; length < good.size(); ++length)
        attempt({good.begin(), good.begin() + std::ptrdiff_t(length)}, example.encoded.layers.size());
    EXPECT_EQ(refused, good.size());
}

TEST(ModelStates, are_near_the_counted_ratios_and_come_back) {
    const BlockModelNumbers numbers;
    std::vector<BitCount> counts(ModelStates().count(), {300, 100});
    counts[numbers.main.sign] = {0, 5000};
    counts[numbers.intra[0]] = {0, 0};
    counts[numbers.intra[1]] = {3, 2};  // too few to be worth a change of state
    const ModelStates states(counts, ModelStates());
    BlockModels models = states.models();
    EXPECT_NEAR(models.mode[0][1][2].zero(), 0.75 * 65536, 0.02 * 65536);
    EXPECT_LT(models.main.sign.zero(), 0.002 * 65536);
    EXPECT_EQ(models.intra[0].zero(), 32768u);
    EXPECT_EQ(models.intra[1].zero(), 32768u);
    BlockWriter writer;
    ModelStates(states).code(writer, ModelStates());
    const std::vector<std::uint8_t> bytes = writer.finish();
    BlockReader reader(bytes);
    ModelStates back;
    back.code(reader, ModelStates());
    std::vector<std::uint32_t> expected, found;
    models.for_each([&](coding::BitModel& model) { expected.push_back(model.zero()); });
    BlockModels of_back = back.models();
    of_back.for_each([&](coding::BitModel& model) { found.push_back(model.zero()); });
    EXPECT_EQ(expected, found);
    EXPECT_TRUE(reader.all_read());
    EXPECT_FALSE(reader.ended());
}

}  // namespace
}  // namespace hogel::codec::decode
