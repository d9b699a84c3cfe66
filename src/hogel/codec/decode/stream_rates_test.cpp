// SPDX-License-Identifier: Apache-2.0
#include "hogel/compress.h"

#include <gtest/gtest.h>

#include <numeric>

#include "hogel/codec/test_damage.h"
#include "hogel/codec/test_fields.h"
#include "hogel/error.h"

namespace hogel::codec::decode {
namespace {

double sum_of(const Array<double, 2>& bytes) {
    return std::accumulate(bytes.elements().begin(), bytes.elements().end(), 0.0);
}

CompressionOptions options_of(const char* coder) {
    CompressionOptions options;
    options.method.coder = coder;
    options.target = Step{0.02};
    options.tile = HogelRange{0, 0, 4, 3};
    return options;
}

// All tiles of a layer lie beside each other in a file.
TEST(StreamRates, bytes_of_hogels_are_those_of_the_layers) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(7, 5, 8, 6, 3);
    for (const char* coder : {"hogel", "threepass"}) {
        compress(field, folder / "a.hgl", options_of(coder));
        const StreamInfo info = read_stream_info(folder / "a.hgl");
        double before = 0;
        const double first = sum_of(bytes_of_hogels(folder / "a.hgl", 1));
        for (std::size_t layers = 1; layers <= info.layer_ends.size(); ++layers) {
            const Array<double, 2> bytes = bytes_of_hogels(folder / "a.hgl", layers);
            ASSERT_EQ(bytes.extent(0), 5u);
            ASSERT_EQ(bytes.extent(1), 7u);
            EXPECT_GT(sum_of(bytes), before);
            before = sum_of(bytes);
            EXPECT_NEAR(before - first, static_cast<double>(info.layer_ends[layers - 1] - info.layer_ends[0]), 1e-6)
                << coder << layers;
        }
        EXPECT_EQ(sum_of(bytes_of_hogels(folder / "a.hgl")), before);
        EXPECT_THROW(bytes_of_hogels(folder / "a.hgl", info.layer_ends.size() + 1), Error);
    }
}

// A hogel that holds noise, among others that hold nothing.
TEST(StreamRates, a_hogel_of_noise_takes_the_bytes) {
    const TestFolder folder;
    const LightFieldGrid grid{6, 5, 1e-3, 16, 16, Perspective{0.1, 0.1}, 1};
    LightFieldBuffer field(grid);
    std::uint32_t random = 1;
    for (std::size_t v = 0; v < 16; ++v)
        for (std::size_t u = 0; u < 16; ++u) {
            random = random * 1664525 + 1013904223;
            field.radiance(0, 3, 4, v, u) = static_cast<float>(random >> 8) * 0x1p-24f;
        }
    compress(field, folder / "a.hgl", options_of("hogel"));
    const Array<double, 2> bytes = bytes_of_hogels(folder / "a.hgl");
    EXPECT_GT(bytes(3, 4), 100);
    for (std::size_t t = 0; t < 5; ++t)
        for (std::size_t s = 0; s < 6; ++s)
            EXPECT_TRUE((t == 3 && s == 4) || bytes(t, s) < 0.3 * bytes(3, 4)) << s << t << bytes(t, s);
}

TEST(StreamRates, refuses_what_is_no_stream) {
    const TestFolder folder;
    write_bytes(folder / "a.hgl", {1, 2, 3});
    EXPECT_THROW(bytes_of_hogels(folder / "a.hgl"), Error);
}

}  // namespace
}  // namespace hogel::codec::decode
