// SPDX-License-Identifier: Apache-2.0
#include "hogel/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "hogel/error.h"
#include "hogel/units.h"
#include "hogel/words/texts.h"

namespace hogel {
namespace {

// Lengths, angles and numbers over many orders of magnitude, some of them with few digits.
std::vector<double> values(std::size_t count) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> mantissa(-10, 10), exponent(-9, 2);
    std::vector<double> all{0, 1, 16e-3, 633e-9, 1.5625e-6, 3.74e-6, 0.1 + 0.2};
    while (all.size() < count) {
        const double magnitude = std::pow(10, std::round(exponent(random)));
        all.push_back(mantissa(random) * magnitude);
        all.push_back(std::round(mantissa(random) * 100) / 100 * magnitude);
    }
    return all;
}

TEST(Texts, of_lengths_read_as_the_same_number) {
    for (const double metres : values(2000)) EXPECT_EQ(parse_any_length(length_text(metres), "x"), metres);
    EXPECT_EQ(length_text(16e-3), "16mm");
    EXPECT_EQ(length_text(460e-9), "460nm");
    EXPECT_EQ(length_text(1.5), "1.5m");
    EXPECT_EQ(length_text(0), "0mm");
    EXPECT_EQ(length_text(-1.6025641025641025e-06), "-1.6025641025641025um");
    EXPECT_EQ(length_text(2e-12), "0.002nm");
    EXPECT_EQ(length_text(1200), "1200m");
}

TEST(Texts, of_angles_read_as_the_same_number) {
    for (const double radians : values(2000)) EXPECT_EQ(parse_angle(angle_text(radians), "x"), radians);
    EXPECT_EQ(angle_text(std::numbers::pi / 4), "45deg");
    EXPECT_EQ(angles_text({std::numbers::pi / 4, std::numbers::pi / 4}), "45deg");
    EXPECT_EQ(angles_text({std::numbers::pi / 4, std::numbers::pi / 9}), "45,20deg");
}

TEST(Texts, of_points_read_as_the_same_number) {
    const std::vector<double> all = values(900);
    for (std::size_t i = 0; i + 2 < all.size(); i += 3) {
        const Vec3 point{all[i], all[i + 1], all[i + 2]};
        EXPECT_EQ(parse_point(point_text(point), "x"), point) << point_text(point);
    }
    EXPECT_EQ(point_text({0, 0, 0.3}), "0,0,300mm");
    EXPECT_EQ(point_text({1e-3, 0, 0}), "1,0,0mm");
    EXPECT_EQ(point_text({1.5, 0, 1e-3}), "1.5m,0,1mm");
}

TEST(Texts, of_pairs_of_angles_read_as_the_same_number) {
    const std::vector<double> all = values(600);
    for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
        const Angles angles{all[i], all[i + 1]};
        EXPECT_EQ(words::parse_angles(angles_text(angles), "x"), angles) << angles_text(angles);
    }
}

// Parameters of a command, with all kinds of values.
struct Asked {
    std::string scene, name = "epi";
    std::optional<double> step;
    double share = 0.5, depth = 0, size = 20e-3;
    bool flat = false, size_given = false;
    Counts hogels{400, 300}, picture{400, 0};
    Angles fov{0.5, 0.25};
    Vec3 eye{0, 0, 0.3};
    std::vector<double> wavelengths;
    std::vector<std::string> lights;
    std::uint64_t seed = 1;
    Parameters parameters;

    Asked() {
        parameters.positional("scene", scene, "SCENE", "");
        parameters.choice("--name", name, {"epi", "raytrace"}, "NAME", "");
        parameters.number("-s,--step", step, "N", "").positive();
        parameters.number("--share", share, "0..1", "").range(0, 1);
        parameters.length("--depth", depth, "");
        parameters.positive_length("--size,--width", size, "").sets(size_given).sets_parameter("pitch");
        parameters.flag("--flat", flat, "").excludes("--depth");
        parameters.counts("--hogels", hogels, "");
        parameters.resolution("--picture", picture, "");
        parameters.angles("--fov", fov, "");
        parameters.point("--eye", eye, "");
        parameters.wavelengths(wavelengths);
        parameters.texts("--light", lights, "L", "");
        parameters.whole("--seed", seed, 1000, "");
    }

    void read(const std::string& parameter, const std::string& text) {
        parameters.look_up(parameter)->read_value(text, "--" + parameter);
    }
    std::string written(const std::string& parameter) { return parameters.look_up(parameter)->written(); }
};

TEST(Parameters, have_names_letters_and_other_names) {
    const Asked asked;
    EXPECT_TRUE(asked.parameters.look_up("scene")->is_positional);
    EXPECT_TRUE(asked.parameters.look_up("scene")->is_required);
    EXPECT_EQ(asked.parameters.look_up("--step")->letter, "s");
    EXPECT_EQ(asked.parameters.look_up("size")->alias, "width");
    EXPECT_EQ(asked.parameters.look_up("flat")->excluded, std::vector<std::string>{"depth"});
    EXPECT_EQ(asked.parameters.look_up("nosuch"), nullptr);
    EXPECT_THROW((void)asked.parameters.given("nosuch"), Error);
}

TEST(Parameters, show_the_values_that_variables_have_as_defaults) {
    const Asked asked;
    EXPECT_EQ(asked.parameters.look_up("size")->shown_default, "20mm");
    EXPECT_EQ(asked.parameters.look_up("hogels")->shown_default, "400x300");
    EXPECT_EQ(asked.parameters.look_up("picture")->shown_default, "400");
    EXPECT_EQ(asked.parameters.look_up("eye")->shown_default, "0,0,300mm");
    EXPECT_EQ(asked.parameters.look_up("wavelength")->shown_default, "rgb");
    EXPECT_EQ(asked.parameters.look_up("step")->shown_default, "");
    EXPECT_EQ(asked.parameters.look_up("flat")->shown_default, "");
}

TEST(Parameters, set_variables_and_say_that_they_are_given) {
    Asked asked;
    asked.read("size", "2cm");
    asked.read("hogels", "8");
    asked.read("picture", "640x480");
    asked.read("wavelength", "633,532nm");
    asked.read("light", "1,1,1:red 0,0,1");
    asked.read("step", "0.25");
    asked.read("flat", "yes");
    EXPECT_TRUE(asked.size_given && asked.flat);
    EXPECT_TRUE(asked.parameters.given("--size") && !asked.parameters.given("depth"));
    EXPECT_EQ(asked.hogels, (Counts{8, 8}));
    EXPECT_EQ(asked.picture, (Counts{640, 480}));
    EXPECT_EQ(asked.lights, (std::vector<std::string>{"1,1,1:red", "0,0,1"}));
    EXPECT_EQ(asked.step, 0.25);
    EXPECT_EQ(asked.written("size"), "20mm");
    EXPECT_EQ(asked.written("wavelength"), "633nm,532nm");
    EXPECT_EQ(asked.written("light"), "1,1,1:red 0,0,1");
    EXPECT_EQ(asked.parameters.look_up("size")->value(), "2cm");
}

TEST(Parameters, written_and_read_again_have_the_same_values) {
    Asked asked;
    asked.fov = {0.1 + 0.2, 1.0 / 3};
    asked.eye = {1.0 / 3, 2e-9, -0.7};
    asked.wavelengths = {1e-6 / 3};
    asked.share = 1.0 / 7;
    Asked again;
    for (const char* name : {"fov", "eye", "wavelength", "share", "size", "hogels", "picture", "name", "seed"})
        again.read(name, asked.written(name));
    EXPECT_EQ(again.fov, asked.fov);
    EXPECT_EQ(again.eye, asked.eye);
    EXPECT_EQ(again.wavelengths, asked.wavelengths);
    EXPECT_EQ(again.share, asked.share);
    EXPECT_EQ(again.picture, asked.picture);
}

// Returns the message of the error of a text.
std::string refusal(const std::string& name, const std::string& text) {
    Asked asked;
    try {
        asked.read(name, text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_FALSE(asked.parameters.given(name));
        return error.what();
    }
    return "accepted";
}

TEST(Parameters, refuse_what_is_no_value) {
    EXPECT_EQ(refusal("name", "raytrac"), "--name: 'raytrac' is none of epi, raytrace (did you mean raytrace?)");
    EXPECT_EQ(refusal("share", "1.5"), "--share: '1.5' is not a number from 0 to 1");
    EXPECT_EQ(refusal("share", "nan"), "--share: 'nan' is not a number from 0 to 1");
    EXPECT_EQ(refusal("step", "0"), "--step: '0' is not a positive number");
    EXPECT_EQ(refusal("size", "0mm"), "--size: '0mm' is not a positive length");
    EXPECT_EQ(refusal("seed", "1001"), "--seed: '1001' is not a whole number from 0 to 1000");
    EXPECT_EQ(refusal("hogels", "8x"), "--hogels: '' is not a positive whole number; write e.g. 256x256");
    EXPECT_EQ(refusal("flat", "maybe"), "--flat: 'maybe' is neither yes nor no");
    EXPECT_EQ(refusal("wavelength", "1,2,3,4um"), "--wavelength: 4 given; expected at most three");
}

}  // namespace
}  // namespace hogel
