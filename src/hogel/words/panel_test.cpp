// SPDX-License-Identifier: Apache-2.0
// Patterns for panels, written and read again.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "hogel/error.h"
#include "hogel/files.h"
#include "hogel/image.h"
#include "hogel/requests.h"
#include "hogel/units.h"
#include "hogel/words/test_texts.h"

namespace hogel {
namespace {

using namespace literals;
using Complex = std::complex<float>;
namespace fs = std::filesystem;

constexpr std::size_t width = 24, height = 18;

class PanelPatterns : public testing::Test {
  protected:
    void SetUp() override {
        if (!image_formats_are_built_in()) GTEST_SKIP() << "needs PNG";
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    static bool image_formats_are_built_in() {
        try {
            require_raw_pixels_name("p.png");
            return true;
        } catch (const Error&) {
            return false;
        }
    }

    // Returns the field, in cycles, of a pattern that is written with these parameters and read from its file alone.
    Array<double, 2> read_again(Metadata texts, std::vector<Array<std::uint16_t, 2>>* sent = nullptr) const {
        texts.emplace_back("pixel-pitch", "8um");
        return read_again(field_, std::move(texts), sent);
    }
    Array<double, 2> read_again(const std::shared_ptr<const FieldSource>& shown, Metadata texts,
                                std::vector<Array<std::uint16_t, 2>>* sent = nullptr) const {
        texts.insert(texts.end(), {{"encoding", "phase"}, {"pixels", "24x18"}});
        const FromTexts<PatternParameters> asked(texts);
        const Fields fields{shown};
        SuitablePatterns encoded = asked.values.encode(fields);
        std::vector<Array<std::uint16_t, 2>> levels = asked.values.panel_levels(encoded, fields);
        const Metadata entries = asked.values.metadata(encoded, fields);
        encoded.patterns[0].levels = levels[0];
        write_levels(folder_ / "p.png", joined_levels(encoded.patterns), encoded.patterns[0].max_level, entries);
        if (sent != nullptr) *sent = std::move(levels);
        const auto field = open_external_field(folder_ / "p.png", {});
        Array<Complex, 2> samples({height, width});
        field->read({0, 0, width, height}, 0, samples);
        Array<double, 2> cycles({height, width});
        for (std::size_t i = 0; i < cycles.size(); ++i)
            cycles.data()[i] = std::arg(samples.data()[i]) / (2 * std::numbers::pi);
        return cycles;
    }

    static double wanted(std::size_t y, std::size_t x) { return 0.013 * double(x) + 0.021 * double(y * y); }

    template <class Of>
    static std::shared_ptr<const FieldSource> field_of_phases(double pitch, const Of& cycles) {
        auto field = std::make_shared<Field>(FieldGrid{{width, height, pitch, pitch, 0, 0}, 532_nm});
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x)
                field->samples(y, x) = Complex(std::polar(1.0, 2 * std::numbers::pi * cycles(y, x)));
        return field;
    }

    // Writes a level table that permutes this number of levels.
    std::string permuted_levels(std::size_t levels) const {
        std::ofstream table(folder_ / "table.csv");
        table << "# a permutation\n";
        for (std::size_t i = 0; i < levels; ++i) table << i << "," << i * 77 % levels << "\n";
        return (folder_ / "table.csv").string();
    }

    fs::path folder_ = fs::path(testing::TempDir()) / ("hogel_panel_" + std::to_string(::getpid()));
    std::shared_ptr<const FieldSource> field_ = field_of_phases(8_um, wanted);
};

template <class Of>
void expect_cycles(const Array<double, 2>& cycles, double tolerance, const Of& of) {
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            ASSERT_LT(std::abs(std::remainder(cycles(y, x) - of(y, x), 1.0)), tolerance) << y << ", " << x;
}

TEST_F(PanelPatterns, give_back_the_phases_behind_tables_and_flips_within_half_a_level) {
    for (const std::size_t levels : {256, 1024}) {
        const std::string table = permuted_levels(levels);
        for (const char* flip : {"none", "horizontal", "vertical", "both"})
            for (const char* code : {"hogel", "slmsuite", "odak"}) {
                const Metadata texts{
                    {"levels", std::to_string(levels)}, {"flip", flip}, {"phase-code", code}, {"lut", table}};
                expect_cycles(read_again(texts), 0.5 / double(levels - 1) + 1e-6, wanted);
            }
    }
}

TEST_F(PanelPatterns, of_every_modulator_give_back_a_plane_wave_within_half_a_level) {
    const auto plane_wave = [](std::size_t y, std::size_t x) { return 0.0713 * double(x) - 0.0279 * double(y) + 0.1; };
    std::size_t count = 0;
    for (const Modulator& modulator : modulators().rows()) {
        if (modulator.modulation == "amplitude") continue;
        SCOPED_TRACE(modulator.name);
        Metadata texts{{"pixel-pitch", lengths_text({modulator.pitch})},
                       {"levels", std::to_string(modulator.levels)},
                       {"phase-code", modulator.phase_code},
                       {"flip", modulator.flip},
                       {"lut", permuted_levels(std::max(modulator.levels, 256u))}};
        std::erase_if(texts, [](const auto& entry) { return entry.second.empty(); });
        // A closed code has a step less than levels.
        const double steps = modulator.levels - (modulator.phase_code.empty() ? 0.0 : 1.0);
        expect_cycles(read_again(field_of_phases(modulator.pitch, plane_wave), texts), 0.5 / steps + 1e-5, plane_wave);
        ++count;
    }
    EXPECT_GT(count, 0u);
}

TEST_F(PanelPatterns, send_columns_and_rows_in_reverse_order) {
    std::vector<Array<std::uint16_t, 2>> plain, both, across;
    read_again({}, &plain);
    read_again({{"flip", "both"}}, &both);
    read_again({{"flip", "horizontal"}}, &across);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            ASSERT_EQ(both[0](y, x), plain[0](height - 1 - y, width - 1 - x));
            ASSERT_EQ(across[0](y, x), plain[0](y, width - 1 - x));
        }
}

TEST_F(PanelPatterns, contain_lens_and_grating) {
    const auto lens = [](std::size_t y, std::size_t x) {
        const double right = 8e-6 * (double(x) - 11.5), down = 8e-6 * (double(y) - 8.5);
        return wanted(y, x) - (right * right + down * down) / (2 * 532e-9 * 0.05);
    };
    expect_cycles(read_again({{"lens", "50mm"}}), 0.5 / 256 + 1e-6, lens);
    // Cycles a pixel to the right and upwards.
    expect_cycles(read_again({{"blaze", "0.25,-0.1"}, {"flip", "both"}}), 0.5 / 256 + 1e-6,
                  [](std::size_t y, std::size_t x) {
                      return wanted(y, x) + 0.25 * (double(x) - 11.5) + 0.1 * (double(y) - 8.5);
                  });
}

TEST_F(PanelPatterns, add_the_levels_of_a_correction_as_they_are_sent) {
    Array<std::uint8_t, 3> correction({height, width, 1});
    for (std::size_t i = 0; i < correction.size(); ++i) correction.data()[i] = static_cast<std::uint8_t>(i * 37);
    write_raw_pixels(folder_ / "c.png", correction);
    for (const char* code : {"hogel", "slmsuite"}) {
        std::vector<Array<std::uint16_t, 2>> plain, corrected;
        const std::string file = (folder_ / "c.png").string();
        read_again({{"flip", "horizontal"}, {"phase-code", code}}, &plain);
        read_again({{"flip", "horizontal"}, {"phase-code", code}, {"correction", file}}, &corrected);
        for (std::size_t i = 0; i < plain[0].size(); ++i) {
            const int sum = plain[0].data()[i] + correction.data()[i];
            ASSERT_EQ(corrected[0].data()[i], sum % 256) << code;
        }
        EXPECT_EQ(external_facts(folder_ / "p.png").panel.correction, file);
    }
}

TEST_F(PanelPatterns, that_do_not_fit_the_panel_are_refused_by_option) {
    const auto parameter_of = [&](const Metadata& texts) -> std::string {
        try {
            read_again(texts);
        } catch (const Error& error) {
            return error.code() == ErrorCode::usage ? error.parameter() : "file";
        }
        return "";
    };
    Array<std::uint8_t, 3> small({2, 2, 1});
    write_raw_pixels(folder_ / "small.png", small);
    EXPECT_EQ(parameter_of({{"correction", (folder_ / "small.png").string()}}), "correction");
    const auto table = [&](const std::string& text) {
        std::ofstream(folder_ / "t.txt") << text;
        return parameter_of({{"lut", (folder_ / "t.txt").string()}});
    };
    std::string many;
    for (int i = 0; i < 255; ++i) many += std::to_string(i) + "\n";
    EXPECT_EQ(table(many), "lut");
    EXPECT_EQ(table(many + "256\n"), "lut");
    EXPECT_EQ(table(many + "255\n"), "");
    EXPECT_EQ(table(""), "file");
    EXPECT_EQ(table("1 2 3\n"), "file");
    EXPECT_EQ(table("1 0\n"), "file");
    EXPECT_EQ(table("high\n"), "file");
    EXPECT_EQ(table("65536\n"), "file");
    EXPECT_EQ(parameter_of({{"blaze", "0.25"}}), "blaze");
    EXPECT_EQ(parameter_of({{"blaze", "0.6,0"}}), "blaze");
    EXPECT_EQ(parameter_of({{"blaze", "0.5,-0.5"}}), "");
}

}  // namespace
}  // namespace hogel
