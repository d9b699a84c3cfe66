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

TEST(Units, lengths_are_the_numbers_that_a_program_writes) {
    EXPECT_EQ(parse_length("460nm", "x"), 460e-9);
    EXPECT_EQ(parse_length("1.5625um", "x"), 1.5625e-6);
    EXPECT_EQ(parse_length("-40um", "x"), -40e-6);
    EXPECT_EQ(parse_length("+3.74mm", "x"), 3.74e-3);
    EXPECT_EQ(parse_length("1.3e+1cm", "x"), 0.13);
    EXPECT_EQ(parse_length("46E-1um", "x"), 4.6e-6);
    EXPECT_EQ(parse_length("0e99999999999mm", "x"), 0);
    EXPECT_GE(parse_length("1e-320nm", "x"), 0);
    EXPECT_LT(parse_length("1e-320nm", "x"), 1e-320);
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

TEST(Units, durations_have_the_unit_that_reads_best) {
    const std::pair<double, const char*> durations[] = {{0, "0.0 s"},
                                                        {0.25, "0.2 s"},
                                                        {12.4, "12 s"},
                                                        {119, "119 s"},
                                                        {120, "2.0 minutes"},
                                                        {3600, "60 minutes"},
                                                        {7200, "2.0 hours"},
                                                        {47.6 * 3600, "48 hours"},
                                                        {172800, "2.0 days"},
                                                        {86400 * 700, "700 days"},
                                                        {86400 * 366 * 30., "30 years"}};
    for (const auto& [seconds, text] : durations) EXPECT_EQ(format_duration(seconds), text);
}

}  // namespace
}  // namespace hogel
