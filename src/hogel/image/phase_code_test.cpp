// SPDX-License-Identifier: Apache-2.0
#include "hogel/phase_code.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hogel/error.h"

namespace hogel {
namespace {

using std::numbers::pi;

double around(double phase) { return std::remainder(phase, 2 * pi); }

// Formulas as in the programs of the makers.
TEST(PhaseCode, decodes_what_its_maker_encodes) {
    for (int i = 0; i < 256; ++i) {
        const double v = i;
        EXPECT_NEAR(around(parse_phase_code("hogel").phase(v, 255) - 2 * pi * v / 256), 0, 1e-12);
        EXPECT_NEAR(around(parse_phase_code("odak").phase(v, 255) - 2 * pi * v / 255), 0, 1e-12);
        EXPECT_NEAR(around(parse_phase_code("slmsuite").phase(v, 255) - 2 * pi * (255 - v) / 256), 0, 1e-12);
        EXPECT_NEAR(around(parse_phase_code("neural-holography").phase(v, 255) - (2 * pi * (1 - v / 255) - pi)), 0,
                    1e-12);
        EXPECT_NEAR(around(parse_phase_code("tensorholo").phase(v / 255, 0) - 2 * pi * (v / 255 - 0.5)), 0, 1e-12);
    }
}

TEST(PhaseCode, encodes_each_level_as_itself_where_no_two_are_one_phase) {
    for (const unsigned largest : {1u, 15u, 255u, 65535u})
        for (const char* text : {"hogel", "slmsuite", "range=350deg", "range=1.5pi,offset=-20deg,invert"}) {
            const PhaseCode code = parse_phase_code(text);
            for (unsigned v = 0; v <= largest; v += 1 + largest / 500)
                ASSERT_EQ(code.level(code.phase(v, largest), largest), v) << text << " " << largest;
        }
    // Both ends of a closed range are the same phase.
    for (const char* text : {"odak", "neural-holography", "tensorholo"}) {
        const PhaseCode code = parse_phase_code(text);
        for (unsigned v = 1; v < 255; ++v) ASSERT_EQ(code.level(code.phase(v, 255), 255), v) << text;
        const unsigned end = code.level(code.phase(0, 255), 255);
        EXPECT_TRUE(end == 0 || end == 255) << text;
    }
}

TEST(PhaseCode, encodes_the_nearest_phase) {
    for (const char* text : {"hogel", "odak", "neural-holography", "slmsuite", "tensorholo", "range=3pi", "range=1.2pi",
                             "range=350deg,offset=1rad,invert"}) {
        const PhaseCode code = parse_phase_code(text);
        for (double phase = -10; phase < 10; phase += 0.0317) {
            const unsigned got = code.level(phase, 63);
            ASSERT_LE(got, 63u);
            double best = 10;
            for (unsigned v = 0; v < 64; ++v) best = std::min(best, std::abs(around(code.phase(v, 63) - phase)));
            EXPECT_NEAR(std::abs(around(code.phase(got, 63) - phase)), best, 1e-9) << text << " " << phase;
        }
    }
}

TEST(PhaseCode, of_other_words_is_refused) {
    for (const char* text : {"", "odka", "range", "range=", "range=2", "range=0pi", "range=-2pi", "range=nanpi",
                             "invert,", "range=2pi,,invert", "range=2pi,sign=1", "offset=1e9pi"})
        EXPECT_THROW(parse_phase_code(text), Error) << text;
    EXPECT_TRUE(parse_phase_code("invert").inverted);
    EXPECT_NEAR(parse_phase_code("offset=-pi").offset, -pi, 1e-15);
    EXPECT_NEAR(parse_phase_code("range=360deg").range, 2 * pi, 1e-12);
}

TEST(PhaseCode, its_text_encodes_the_same_levels_of_8_bits) {
    for (const PhaseCodeInfo& known : phase_codes().rows()) EXPECT_EQ(phase_code_text(known.code), known.name);
    for (const bool closed : {false, true})
        for (const bool inverted : {false, true}) {
            const PhaseCode code{4.4, -0.3, inverted, closed};
            const PhaseCode again = parse_phase_code(phase_code_text(code));
            for (double phase = -10; phase < 10; phase += 0.0317)
                EXPECT_EQ(again.level(phase, 255), code.level(phase, 255)) << phase_code_text(code) << " " << phase;
        }
}

}  // namespace
}  // namespace hogel
