// SPDX-License-Identifier: Apache-2.0
// Parameters that have an effect, written and read again, make the same request.
#include "hogel/requests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "hogel/error.h"
#include "hogel/words/test_texts.h"

namespace hogel {
namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;

// Returns the parameter names of an error of the request.
template <class Values, class Request>
std::string refused(const Texts& texts, const Request& request) {
    try {
        request(FromTexts<Values>(texts).values);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        return error.parameter();
    }
    return "accepted";
}

LightField light_field(bool with_depth) {
    const LightFieldGrid grid{2, 2, 1e-4, 2, 2, field_of_view(0.3, 0.3, 0, 0)};
    return LightField(std::make_shared<LightFieldBuffer>(grid, with_depth));
}

using Targets = std::tuple<std::size_t, double, double, RateRule, std::optional<double>>;

Targets values_of(const CompressionTarget& target) {
    const auto* ratio = std::get_if<Sqnr>(&target);
    const auto* rate = std::get_if<PixelsPerBit>(&target);
    return {target.index(), ratio != nullptr ? ratio->decibels : 0, rate != nullptr ? rate->rate : 0,
            rate != nullptr ? rate->rule : RateRule::search, rate != nullptr ? rate->overhead : std::nullopt};
}

TEST(CompressionParameters, that_act_make_the_same_options_again) {
    const LightField deep = light_field(true);
    for (const Texts& texts :
         std::vector<Texts>{{},
                            {{"sqnr", "31.5"}, {"no-depth", "yes"}, {"tile", "3x2"}},
                            {{"coder", "threepass"}, {"ppb", "3"}, {"rule", "planes"}},
                            {{"coder", "fringes"}, {"symbols", "alphabets"}, {"transform", "haar"}},
                            {{"coder", "jpeg4d"}, {"table", "jpeg"}, {"chrominance", "2"}},
                            {{"tone", "histogram"}, {"tone-decades", "2"}, {"depth-error", "0mm"}},
                            {{"lossless", "yes"}}}) {
        FromTexts<CompressionParameters> asked(texts);
        asked.values.resolve(deep);
        const CompressionOptions made = asked.values.options(deep);
        const CompressionOptions again = FromTexts<CompressionParameters>(asked.table.acting()).values.options(deep);
        EXPECT_EQ(again.method, made.method);
        EXPECT_EQ(values_of(again.target), values_of(made.target));
        EXPECT_EQ(again.tile.has_value(), made.tile.has_value());
        EXPECT_EQ(again.with_depth, made.with_depth);
        EXPECT_EQ(again.depth_error, made.depth_error);
        EXPECT_EQ(again.tone_decades, made.tone_decades);
        EXPECT_EQ(again.chrominance, made.chrominance);
    }
}

TEST(CompressionParameters, that_a_coder_or_a_light_field_does_not_have_are_refused) {
    const auto of = [](const Texts& texts, bool with_depth = false) {
        return refused<CompressionParameters>(texts,
                                              [&](const auto& values) { values.options(light_field(with_depth)); });
    };
    EXPECT_EQ(of({}), "accepted");
    EXPECT_EQ(of({{"table", "own"}}), "table");
    EXPECT_EQ(of({{"symbols", "bits"}}), "symbols");
    EXPECT_EQ(of({{"ppb", "8"}, {"rule", "planes"}}), "rule");
    EXPECT_EQ(of({{"ppb", "8"}, {"overhead", "2"}}), "overhead");
    EXPECT_EQ(of({{"transform", "magic"}}), "transform");
    EXPECT_EQ(of({{"depth-error", "1um"}}), "depth_error");
    EXPECT_EQ(of({{"depth-error", "1um"}}, true), "accepted");
    EXPECT_EQ(of({{"depth-error", "-1um"}}, true), "depth_error");
}

TEST(PatternParameters, that_act_make_the_same_options_again) {
    const Texts described{{"pixels", "40x30"}, {"pixel-pitch", "8um"}, {"levels", "16"}, {"clip", "0.1"}};
    const Texts named{{"device", "LETO"}, {"window", "8"}, {"iterations", "3"}, {"phase-code", "range=300deg,invert"}};
    const Texts with_reference{{"device", "pluto"}, {"reference", "1.5deg"}};
    for (const Texts& texts : {described, named, with_reference})
        for (const EncodingInfo& encoding : encodings().rows()) {
            FromTexts<PatternParameters> asked(texts);
            asked.values.resolve(encoding.encoding);
            const PatternOptions made = asked.values.options();
            const PatternOptions again = FromTexts<PatternParameters>(asked.table.acting()).values.options();
            EXPECT_EQ(made.encoding, encoding.encoding);
            EXPECT_EQ(again.encoding, made.encoding);
            EXPECT_EQ(again.clip, made.clip);
            const auto same_for = [&](bool acts, const auto& member) {
                EXPECT_TRUE(!acts || again.*member == made.*member) << encoding.name;
            };
            same_for(encoding.encoding != Encoding::binary, &PatternOptions::modulator);
            same_for(encoding.phase_only, &PatternOptions::phase_code);
            same_for(encoding.encoding == Encoding::gerchberg_saxton, &PatternOptions::window);
            same_for(encoding.encoding == Encoding::gradient, &PatternOptions::iterations);
            same_for(encoding.encoding == Encoding::bipolar, &PatternOptions::reference_angle);
        }
}

TEST(PatternParameters, describe_one_modulator) {
    const auto of = [](const Texts& texts) {
        return refused<PatternParameters>(texts, [](const auto& values) { values.modulator(); });
    };
    EXPECT_EQ(of({{"device", "leto"}}), "accepted");
    EXPECT_EQ(of({{"pixels", "8"}, {"pixel-pitch", "8um"}}), "accepted");
    EXPECT_EQ(of({}), "device, pixels, pixel_pitch");
    EXPECT_EQ(of({{"device", "leto"}, {"pixels", "8"}}), "device, pixels, pixel_pitch");
    EXPECT_EQ(of({{"pixels", "8"}}), "pixels, pixel_pitch");
    EXPECT_EQ(of({{"pixels", "65537x1"}, {"pixel-pitch", "8um"}}), "pixels");
    EXPECT_EQ(of({{"pixels", "8"}, {"pixel-pitch", "8um"}, {"levels", "65537"}}), "levels");
    EXPECT_EQ(of({{"device", "zeus"}}), "device");
}

// The hologram of a scene fits each modulator that hogel knows: samples of its pitch, and hogels of whole pixels that
// fill it but for less than one.
TEST(HologramParameters, fit_every_modulator) {
    for (const Modulator& modulator : modulators().rows())
        for (const bool smooth : {false, true}) {
            HologramParameters hologram;
            LightFieldParameters light_field;
            hologram.wavelengths = {520e-9};
            hologram.fit(modulator, light_field, smooth);
            const LightFieldGrid grid = light_field.grid();
            const FieldGrid made = hologram_grid({&grid, 1}, hologram.request(1, 1).options({520e-9, 1}, {&grid, 1}));
            EXPECT_NEAR(made.plane.pitch_x / modulator.pitch, 1, 1e-12) << modulator.name;
            EXPECT_NEAR(made.plane.pitch_y / modulator.pitch, 1, 1e-12) << modulator.name;
            const double hogel = grid.pitch / modulator.pitch;
            EXPECT_NEAR(hogel, std::round(hogel), 1e-9) << modulator.name;
            EXPECT_LE(made.plane.width, modulator.width) << modulator.name;
            EXPECT_GT(double(made.plane.width) + hogel, double(modulator.width)) << modulator.name;
            EXPECT_GT(double(made.plane.height) + hogel, double(modulator.height)) << modulator.name;
        }
}

TEST(HologramParameters, name_a_size_that_keeps_a_given_pitch) {
    LightFieldParameters light_field;
    light_field.hogels = {60, 34};
    light_field.size = 3e-3;
    HologramParameters hologram;
    hologram.pitch = 8e-6;
    const auto note = [&] { return hologram.note_about_pitch(hologram.request(1, 1), light_field.grid()); };
    EXPECT_EQ(note(), "");
    hologram.pitch_given = true;
    EXPECT_EQ(note(),
              "pitch: 8 um became 8.33333 um because a hogel of 50 um holds 6 samples; hogels of 48 um (--size 2.88mm) "
              "keep the pitch");
    light_field.size = 2.88e-3;
    EXPECT_EQ(note(), "");
}

TEST(HologramParameters, fit_keeps_what_is_given) {
    HologramParameters hologram;
    LightFieldParameters light_field;
    light_field.hogels = {96, 54};
    light_field.directions = {7, 3};
    light_field.hogels_given = light_field.directions_given = true;
    hologram.fit(find_modulator("pluto"), light_field, true);
    EXPECT_EQ(hologram.method, "fourier");
    EXPECT_EQ(light_field.hogels, (Counts{96, 54}));
    EXPECT_EQ(light_field.directions, (Counts{7, 3}));
    EXPECT_NEAR(light_field.size, 1920 * 8e-6, 1e-12);
}

// Checks that a light field suits a modulator: hogels of whole pixels within the panel, and directions in its band.
void expect_fitting(const LightFieldGrid& grid, const Modulator& modulator, double wavelength) {
    SCOPED_TRACE(modulator.name);
    const LightFieldGrid common = common_directions(grid);
    const double pixels = grid.pitch / modulator.pitch;
    EXPECT_NEAR(pixels, std::round(pixels), 1e-6);
    EXPECT_LE(grid.width(), double(modulator.width) * modulator.pitch * (1 + 1e-6));
    EXPECT_LE(grid.height(), double(modulator.height) * modulator.pitch * (1 + 1e-6));
    const double reach = std::abs(common.center_u()) + common.half_u();
    EXPECT_LT(std::sin(std::atan(reach)), wavelength / (2 * modulator.pitch));
}

TEST(HologramParameters, fitted_light_fields_suit_every_modulator) {
    HologramParameters hologram;
    hologram.wavelengths = {520e-9};
    const LightFieldGrid captured{512, 512, 30e-6, 9, 9, FocalPlane{{0.029, 0.029, 0, 0}, -0.3}, 1},
        wide{40, 20, 1e-3, 5, 5, field_of_view(1.2, 0.5, 0.1), 1}, tiny{6, 4, 1e-6, 3, 3, field_of_view(1e-3), 1};
    for (const Modulator& modulator : modulators().rows())
        for (const bool smooth : {false, true})
            for (const LightFieldGrid& grid : {captured, wide, tiny}) {
                const LightField light_field =
                    light_field_from(grid, [](double, double, double, double) { return 1.0; });
                expect_fitting(hologram.fitted(light_field, modulator, smooth).grid(), modulator, 520e-9);
            }
}

TEST(HologramParameters, fitted_keeps_light_fields_that_suit_and_that_have_too_many_hogels) {
    HologramParameters hologram;
    hologram.wavelengths = {520e-9};
    const Modulator pluto = find_modulator("pluto");
    for (const LightFieldGrid& grid : {LightFieldGrid{480, 270, 32e-6, 9, 9, field_of_view(0.0567), 1},
                                       LightFieldGrid{2000, 4, 30e-6, 3, 3, field_of_view(0.5), 1}}) {
        const LightField light_field = light_field_from(grid, [](double, double, double, double) { return 1.0; });
        EXPECT_EQ(hologram.fitted(light_field, pluto, true).grid(), grid);
    }
}

}  // namespace
}  // namespace hogel
