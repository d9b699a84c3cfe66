// SPDX-License-Identifier: Apache-2.0
#include "hogel/patterns/device_profiles.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::patterns {
namespace {

using namespace literals;

// A profile with its members, or other ones.
std::string profile(const std::string& pixels = "[40, 30]", const std::string& levels = R"("levels": 16)",
                    const std::string& others = R"("verified": false)") {
    return R"({"kind": "modulator", "name": "Own panel", "pixels": )" + pixels + R"(, "pixel_pitch_um": 9.2, )" +
           levels + R"(, "modulation": "phase", )" + others + "}";
}

std::string fault_of(const std::string& text) {
    try {
        read_profile("own", text, "own.json");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        return error.what();
    }
    return "";
}

TEST(DeviceProfiles, of_hogel_can_all_be_used) {
    std::set<std::string> names;
    for (const Modulator& own : own_profiles()) {
        EXPECT_EQ(own.fault, "");
        EXPECT_FALSE(own.title.empty());
        EXPECT_TRUE(names.insert(own.name).second) << own.name;
        for (const std::string& alias : own.aliases) EXPECT_TRUE(names.insert(alias).second) << alias;
        EXPECT_EQ(notes_about(own, {}).empty(), own.verified && own.note.empty()) << own.name;
    }
    for (const char* name : {"gaea-2", "leto", "luna", "pluto", "ti-plm"}) EXPECT_EQ(names.count(name), 1u) << name;
}

TEST(DeviceProfiles, are_read_with_all_members) {
    const Modulator made = read_profile(
        "own",
        profile("[40, 30]", R"("bits": 5)", R"("aliases": ["mine"], "fill_factor": 0.9, "wavelengths_nm": [450, 650],
            "refresh_hz": 60, "phase_code": "slmsuite", "flip": "both", "lut": "t.csv", "correction": "/c.png", "source": "https://example.org", "verified": true,
            "note": "warm it up")"),
        "folder/own.json");
    Modulator wanted{"own", 40, 30, 9.2e-6, 32, "Own panel", {"mine"}, "phase", "slmsuite"};
    wanted.fill_factor = 0.9;
    wanted.shortest_wavelength = 450e-9;
    wanted.longest_wavelength = 650e-9;
    wanted.refresh_rate = 60;
    wanted.flip = "both";
    wanted.lut = "folder/t.csv";
    wanted.correction = "/c.png";
    wanted.source = "https://example.org";
    wanted.note = "warm it up";
    EXPECT_EQ(made, wanted);
    EXPECT_EQ(made.pitch, parse_length("9.2um", "pitch"));
    const std::vector<double> wavelengths{532_nm, 700_nm};
    EXPECT_EQ(notes_about(made, wavelengths),
              (std::vector<std::string>{"profile own: warm it up", "own is made for 450 nm to 650 nm, not 700 nm"}));
}

TEST(DeviceProfiles, with_a_fault_are_refused_by_file_member_and_what_was_expected) {
    EXPECT_EQ(fault_of(profile()), "");
    EXPECT_EQ(fault_of("{"), "own.json: its JSON has an error at byte 2");
    EXPECT_EQ(fault_of("[]"), "own.json: expected one object of JSON");
    EXPECT_EQ(fault_of(R"({"kind": "quilt"})"), "own.json: kind: expected modulator, not quilt");
    EXPECT_EQ(fault_of(R"({"kind": 3})"), "own.json: kind: expected modulator");
    EXPECT_EQ(fault_of("{}"), "own.json: kind: expected modulator");
    const std::string sides = "own.json: pixels: expected two whole numbers up to 65536, across and down";
    for (const char* pixels : {"40", "[40]", "[40, 0]", "[40, 1e9]", "[40, 30.5]", "[\"40\", 30]"})
        EXPECT_EQ(fault_of(profile(pixels)), sides);
    EXPECT_EQ(fault_of(profile("[4, 3]", R"("levels": 1)")),
              "own.json: levels: expected a whole number from 2 to " + std::to_string(max_modulator_levels));
    EXPECT_EQ(fault_of(profile("[4, 3]", R"("levels": 16, "bits": 4)")),
              "own.json: levels, bits: expected one of them");
    EXPECT_NE(fault_of(profile("[4, 3]", R"("bits": 17)")), "");
    const auto other = [](const std::string& members) { return fault_of(profile("[4, 3]", R"("bits": 8)", members)); };
    EXPECT_EQ(other(R"("verified": 1)"), "own.json: verified: expected true or false");
    EXPECT_EQ(other(R"("aliases": "mine", "verified": false)"), "own.json: aliases: expected a list of texts");
    EXPECT_EQ(other(R"("verified": true)"),
              "own.json: source: expected the address of a data sheet, as verified is true");
    EXPECT_EQ(other(R"("wavelengths_nm": [650, 450], "verified": false)"),
              "own.json: wavelengths_nm: expected two numbers of nanometres, the shortest wavelength first");
    EXPECT_NE(other(R"("phase_code": "slm", "verified": false)").find("own.json: phase_code: expected a phase code"),
              std::string::npos);
    EXPECT_EQ(other(R"("flip": "x", "verified": false)"),
              "own.json: flip: expected none, horizontal, vertical or both");
    EXPECT_NE(other(R"("pitch": 8, "verified": false)").find("own.json: pitch: is no member of a profile"),
              std::string::npos);
}

TEST(DeviceProfiles, of_a_folder_are_named_by_their_files_and_keep_their_faults) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "profiles";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "own.json") << profile();
    std::ofstream(folder / "bad.json") << profile("8");
    std::ofstream(folder / "notes.txt") << "no profile";
    const std::vector<Modulator> found = profiles_in(folder);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].name, "bad");
    EXPECT_NE(found[0].fault.find("bad.json: pixels: expected"), std::string::npos);
    EXPECT_EQ(found[1], read_profile("own", profile(), "own.json"));
    EXPECT_TRUE(profiles_in(folder / "none").empty());
    std::filesystem::remove_all(folder);
}

TEST(DeviceProfiles, are_found_by_name_or_alias_in_upper_or_lower_case) {
    for (const char* name : {"leto-3", "leto", "LETO", "Leto-3"}) EXPECT_EQ(find_modulator(name).name, "leto-3");
    EXPECT_EQ(find_modulator("ti-plm").levels, 16u);
    try {
        find_modulator("plutoo");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.parameter(), "device");
        EXPECT_NE(std::string(error.what()).find("did you mean 'pluto'?"), std::string::npos) << error.what();
    }
}

TEST(DeviceProfiles, of_an_amplitude_modulator_refuse_phases) {
    Field field({{32, 32, 8_um, 8_um, 0, 0}, 532_nm});
    for (auto& sample : field.samples.elements()) sample = 1;
    PatternOptions options{.modulator = {"own", 32, 32, 8_um}};
    options.modulator.modulation = "amplitude";
    for (const EncodingInfo& encoding : encodings().rows()) {
        options.encoding = encoding.encoding;
        options.reference_angle = 1_deg;
        if (!encoding.phase_only) continue;
        EXPECT_THROW(encode_pattern(field, options), Error) << encoding.name;
    }
}

}  // namespace
}  // namespace hogel::patterns
