// SPDX-License-Identifier: Apache-2.0
#include "hogel/units.h"

#include <gtest/gtest.h>

#include "hogel/error.h"

namespace hogel {
namespace {

using namespace literals;

TEST(Units, lengths_are_metres) {
    EXPECT_DOUBLE_EQ(parse_length("16mm", "size"), 0.016);
    EXPECT_DOUBLE_EQ(parse_length("-12 mm", "focus"), -0.012);
    EXPECT_DOUBLE_EQ(parse_length("633nm", "wavelength"), 633_nm);
    EXPECT_DOUBLE_EQ(parse_length("1.5µm", "pitch"), 1.5e-6);
    EXPECT_DOUBLE_EQ(parse_length("2.5e1cm", "pitch"), 0.25);
    EXPECT_DOUBLE_EQ(parse_angle("180deg", "field of view"), std::numbers::pi);
}

TEST(Units, anything_else_is_a_usage_error_that_names_the_quantity) {
    for (const char* text : {"16", "", "mm", "16 parsec", "nanm", "infm", "1e999m", "16mm2", "0x10mm"}) {
        try {
            parse_length(text, "size");
            FAIL() << "accepted '" << text << "'";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_NE(std::string(error.what()).find("size"), std::string::npos) << error.what();
        }
    }
}

TEST(Units, written_lengths_read_back) {
    for (double length : {16_mm, 1.5625_um, 633_nm, -12_mm, 0.3_m, 2_m})
        EXPECT_NEAR(parse_length(format_length(length), "x"), length, 1e-6 * std::abs(length));
}

}  // namespace
}  // namespace hogel
