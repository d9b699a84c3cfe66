// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/arrays/mat_write.h"

#include <gtest/gtest.h>

#include <string_view>

#include "hogel/error.h"
#include "hogel/io/arrays/mat.h"

namespace hogel::io::arrays {
namespace {

TEST(MatWriter, writes_arrays_that_are_read_to_the_last_bit) {
    const std::vector<float> real{1, -2, 3.5f, 1e-30f, 0.1f, 7}, imaginary{0, 1, 2, 3, 4, -0.3f};
    const std::size_t shape[2] = {3, 2};
    MatWriter writer("x.mat");
    writer.text("software", "hogel");
    writer.array("field", shape, real, imaginary);
    writer.numbers("pitch", std::vector<double>{8e-6});
    writer.array("plain", shape, real);
    const auto fields = read_mat5("x.mat", writer.bytes());
    ASSERT_EQ(fields.size(), 3u);  // a text is no array of numbers
    EXPECT_EQ(fields[0].shape, (std::vector<std::size_t>{3, 2}));
    ASSERT_EQ(fields[0].imaginary.size(), 24u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(number_at(fields[0].real_number, &fields[0].real[4 * i]), double{real[i]});
        EXPECT_EQ(number_at(fields[0].imaginary_number, &fields[0].imaginary[4 * i]), double{imaginary[i]});
    }
    EXPECT_EQ(fields[1].name, "pitch");
    EXPECT_EQ(number_at(fields[1].real_number, fields[1].real.data()), 8e-6);
    EXPECT_EQ(fields[2].name, "plain");
    EXPECT_TRUE(fields[2].imaginary.empty());
    const std::string only[] = {"plain"};
    const auto named = read_mat5("x.mat", writer.bytes(), only);
    ASSERT_EQ(named.size(), 2u);  // and what may be a parameter
    EXPECT_EQ(named[1].name, "plain");
}

// The bytes are those of the published format, not only what the reader here expects.
TEST(MatWriter, pads_elements_to_eight_bytes) {
    MatWriter writer("x.mat");
    writer.numbers("lambda", std::vector<double>{532e-9});
    const auto& bytes = writer.bytes();
    EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(bytes.data()), 7), "MATLAB ");
    EXPECT_EQ(bytes[124], 0);
    EXPECT_EQ(bytes[125], 1);
    EXPECT_EQ(bytes[126], 'I');
    // Head 8, flags 16, extents 16, name 8 + 8, number 16.
    ASSERT_EQ(bytes.size(), 128u + 8 + 16 + 16 + 16 + 16);
    EXPECT_EQ(bytes[128], 14);
    EXPECT_EQ(bytes[132], 64);
    EXPECT_EQ(bytes[144], 6);  // class double
    EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(&bytes[176]), 8), std::string_view("lambda\0\0", 8));
    EXPECT_EQ(bytes[184], 9);
}

}  // namespace
}  // namespace hogel::io::arrays
