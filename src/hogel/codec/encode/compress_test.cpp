// SPDX-License-Identifier: Apache-2.0
#include "hogel/compress.h"

#include <gtest/gtest.h>

#include "hogel/codec/encode/secant_search.h"
#include "hogel/codec/test_fields.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"
#include "thesis/wavelets/transform.h"

namespace hogel::codec::encode {
namespace {

std::vector<CodingMethod> all_methods() {
    std::vector<CodingMethod> methods{{"hogel", ""}};
    for (const std::string& name : transform_names())
        if (name == "dct8")
            methods.push_back({"jpeg4d", "dct8"});
        else
            methods.push_back({name.size() % 2 == 0 ? "ezw" : "threepass", name});
    methods.push_back({"jpeg4d", "dct8", QuantisationTable::jpeg});
    methods.push_back({"fringes", "cdf97"});
    return methods;
}

CompressionOptions with_sqnr(const CodingMethod& method, double sqnr) {
    CompressionOptions options;
    options.method = method;
    options.target = Sqnr{sqnr};
    return options;
}

// The inverse transform along the directions gives the amplitudes.
TEST(Coefficients, are_those_of_amplitudes_along_directions) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(9, 7, 24, 20, 3);
    compress(field, folder / "a.hgl", with_sqnr({"fringes", "ai33"}, 30));
    const auto source = open_coefficients(folder / "a.hgl").faces().front();
    LightFieldBuffer coefficients(source->grid());
    copy(*source, coefficients);
    const wavelets::Pyramid pyramid = wavelets::Pyramid::separate({std::size_t{3} * 9 * 7, 20, 24}, {{1, 2}});
    wavelets::transform("ai33").inverse(pyramid, coefficients.radiance.elements());
    const LightFieldBuffer expected = decoded(folder / "a.hgl");
    for (std::size_t i = 0; i < expected.radiance.size(); ++i)
        ASSERT_NEAR(std::pow(coefficients.radiance.data()[i], 2), expected.radiance.data()[i], 1e-5) << i;
    compress(field, folder / "b.hgl", with_sqnr({"threepass", "ai33"}, 30));
    EXPECT_EQ(code_of([&] { open_coefficients(folder / "b.hgl"); }), ErrorCode::bad_input);
}

// Each face of a hemicube has its own coefficients; those of an unfolded one belong to no face.
TEST(Coefficients, of_a_hemicube_are_those_of_its_faces) {
    const TestFolder folder;
    std::vector<LightField::Source> faces;
    for (const LightFieldGrid& grid : hemicube({3, 2, 36e-6, 8, 8, Perspective{1, 1}, 1})) {
        auto face = std::make_shared<LightFieldBuffer>(grid);
        for (std::size_t i = 0; i < face->radiance.size(); ++i)
            face->radiance.data()[i] = float(1 + std::sin(0.3 * double(i) + double(faces.size())));
        faces.push_back(face);
    }
    CompressionOptions options = with_sqnr({"fringes", "haar"}, 30);
    compress(LightField(faces), folder / "a.hgl", options);
    const LightField coefficients = open_coefficients(folder / "a.hgl"), decoded = open_stream(folder / "a.hgl");
    ASSERT_EQ(coefficients.faces().size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        const LightFieldGrid& grid = coefficients.faces()[i]->grid();
        LightFieldBuffer amplitudes(grid), expected(grid);
        copy(*coefficients.faces()[i], amplitudes);
        copy(*decoded.faces()[i], expected);
        wavelets::transform("haar").inverse(
            wavelets::Pyramid::separate({grid.hogels(), grid.directions_v, grid.directions_u}, {{1, 2}}),
            amplitudes.radiance.elements());
        for (std::size_t k = 0; k < expected.radiance.size(); ++k)
            ASSERT_NEAR(std::pow(amplitudes.radiance.data()[k], 2), expected.radiance.data()[k], 1e-5) << i << " " << k;
    }
    options.layout = StreamLayout::unfolded;
    compress(LightField(faces), folder / "b.hgl", options);
    EXPECT_EQ(code_of([&] { open_coefficients(folder / "b.hgl"); }), ErrorCode::bad_input);
}

// The SQNR is measured on the decoded samples, not on coefficients, with every transform.
TEST(Compress, meets_the_sqnr_asked_for) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(8, 6, 24, 20, 1);
    for (const CodingMethod& method : all_methods()) {
        const CompressionResult result = compress(field, folder / "a.hgl", with_sqnr(method, 25));
        const double measured = sqnr_of(field, decoded(folder / "a.hgl"));
        EXPECT_NEAR(measured, result.sqnr, 1e-6) << method.transform;
        EXPECT_GE(measured, 25) << method.transform;
        EXPECT_LE(measured, 25.1) << method.transform;
        EXPECT_EQ(result.bytes, std::filesystem::file_size(folder / "a.hgl"));
    }
}

TEST(Compress, meets_the_rate_asked_for_to_the_byte) {
    const TestFolder folder;
    struct Case {
        LightFieldGrid grid;
        double pixels_per_bit;
    };
    for (const Case& c : {Case{{8, 6, 1e-3, 24, 20, Perspective{0.3, 0.3}, 3}, 2.5},
                          {{9, 7, 1e-3, 16, 16, Perspective{0.3, 0.3}, 1}, 1.5},
                          {{31, 1, 1e-3, 33, 1, Perspective{0.3, 0.3}, 1}, 0.2}}) {
        LightFieldBuffer field = textured_planes(c.grid.hogels_s, c.grid.hogels_t, c.grid.directions_u,
                                                 c.grid.directions_v, c.grid.channels);
        // A dark tile has a code too short to be cut.
        LightFieldTile dark(c.grid, {0, 0, 5, std::min<std::size_t>(c.grid.hogels_t, 4)}, false);
        field.write(dark);
        const auto pixels = static_cast<double>(c.grid.hogels() * c.grid.directions());
        for (const CodingMethod& method :
             {CodingMethod{"hogel", ""}, {"threepass", "ai33"}, {"ezw", "cdf97"}, {"jpeg4d", "dct8"}}) {
            CompressionOptions options;
            options.method = method;
            options.target = PixelsPerBit{c.pixels_per_bit};
            if (c.grid.hogels_s == 9) options.tile = HogelRange{0, 0, 5, 4};
            const CompressionResult result = compress(field, folder / "a.hgl", options);
            EXPECT_EQ(std::filesystem::file_size(folder / "a.hgl"), std::floor(pixels / c.pixels_per_bit / 8))
                << method.coder;
            EXPECT_EQ(result.bytes, std::filesystem::file_size(folder / "a.hgl"));
            EXPECT_NEAR(sqnr_of(field, decoded(folder / "a.hgl")), result.sqnr, 1e-6) << method.coder;
            EXPECT_GT(result.sqnr, 5) << method.coder;
        }
    }
}

// Readers do not see filler among the metadata.
TEST(Compress, rate_is_met_with_little_filler) {
    const TestFolder folder;
    CompressionOptions options;
    options.metadata = {{"what", "a test"}};
    options.target = PixelsPerBit{0.5};
    compress(textured_planes(17, 9, 32, 32, 1), folder / "a.hgl", options);
    const StreamInfo info = read_stream_info(folder / "a.hgl");
    EXPECT_GE(info.filler, 14u);
    EXPECT_LT(static_cast<double>(info.filler), 14 + 0.005 * static_cast<double>(info.layer_ends.back()));
    EXPECT_EQ(info.metadata, options.metadata);
}

// [K] 4.4.2: one coding, whose size the histogram of coefficients predicts.
TEST(Compress, a_rule_meets_the_rate_about_and_codes_once) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(16, 12, 32, 32, 3);
    for (const char* coder : {"threepass", "fringes"})
        for (const ZerotreeSymbols symbols : {ZerotreeSymbols::bits, ZerotreeSymbols::alphabets})
            for (const auto& [rule, factor] : {std::pair{RateRule::histogram, 1.5}, {RateRule::planes, 2.2}}) {
                CompressionOptions options;
                options.method = {coder, "ai33", QuantisationTable::own, symbols};
                options.tile = HogelRange{0, 0, 8, 12};
                std::vector<std::uint64_t> bytes;
                for (const std::optional<double>& overhead : {std::optional<double>(), {0.5}, {12}}) {
                    options.target = PixelsPerBit{0.5, rule, overhead};
                    const CompressionResult result = compress(field, folder / "a.hgl", options);
                    EXPECT_EQ(result.passes, 1);
                    EXPECT_EQ(result.bytes, std::filesystem::file_size(folder / "a.hgl"));
                    EXPECT_NEAR(sqnr_of(field, decoded(folder / "a.hgl")), result.sqnr, 1e-6);
                    if (!overhead) {
                        EXPECT_LT(result.pixels_per_bit, 0.5 * factor) << coder;
                        EXPECT_GT(result.pixels_per_bit, 0.5 / factor) << coder;
                    }
                    bytes.push_back(result.bytes);
                }
                EXPECT_GT(bytes[1], bytes[2]) << "more is counted for the trees, so the step is larger";
            }
}

TEST(Compress, rules_and_alphabets_are_those_of_the_three_pass_coder) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(4, 3, 12, 10, 1);
    for (const char* coder : {"hogel", "ezw", "jpeg4d"}) {
        CompressionOptions options;
        options.method.coder = coder;
        options.target = PixelsPerBit{1, RateRule::histogram};
        EXPECT_EQ(code_of([&] { compress(field, folder / "a.hgl", options); }), ErrorCode::usage) << coder;
        options.target = Sqnr{20};
        options.method.symbols = ZerotreeSymbols::alphabets;
        EXPECT_EQ(code_of([&] { compress(field, folder / "a.hgl", options); }), ErrorCode::usage) << coder;
    }
    CompressionOptions options;
    options.method = {"threepass", "haar"};
    for (const PixelsPerBit& target : {PixelsPerBit{1, RateRule::search, 2}, PixelsPerBit{1, RateRule::planes, -1},
                                       PixelsPerBit{1, RateRule::planes, 33}, PixelsPerBit{1e9, RateRule::planes}}) {
        options.target = target;
        EXPECT_EQ(code_of([&] { compress(field, folder / "a.hgl", options); }), ErrorCode::usage);
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.hgl"));
}

TEST(Compress, impossible_rates_are_refused) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(8, 6, 24, 20, 1), dark(field.grid());
    for (const CodingMethod& method : {CodingMethod{"hogel", ""}, {"threepass", "haar"}, {"ezw", "haar"}})
        for (const double rate : {0.03, 1000.0, 1e9}) {
            CompressionOptions options;
            options.method = method;
            options.target = PixelsPerBit{rate};
            EXPECT_EQ(code_of([&] { compress(field, folder / "a.hgl", options); }), ErrorCode::usage) << rate;
            options.target = PixelsPerBit{1};
            EXPECT_EQ(code_of([&] { compress(dark, folder / "a.hgl", options); }), ErrorCode::usage);
        }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.hgl"));
}

// Qualities finer than floats or levels can represent.
TEST(Compress, impossible_quality_is_refused) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(4, 3, 12, 10, 1);
    for (const char* coder : {"hogel", "threepass"}) {
        CompressionOptions fine = with_sqnr({coder, ""}, 100);
        EXPECT_GE(compress(field, folder / "a.hgl", fine).sqnr, 100);
        EXPECT_GE(sqnr_of(field, decoded(folder / "a.hgl")), 100);
        fine.target = Step{1e-10};
        EXPECT_EQ(code_of([&] { compress(field, folder / "b.hgl", fine); }), ErrorCode::usage);
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "b.hgl"));
}

TEST(Compress, light_fields_of_any_size_come_back) {
    const TestFolder folder;
    struct Case {
        std::size_t s, t, u, v, channels;
    };
    for (const Case& c : {Case{1, 1, 1, 1, 1}, {1, 1, 7, 5, 3}, {13, 1, 11, 1, 1}, {3, 5, 2, 17, 3}, {1, 9, 31, 3, 1}})
        for (const CodingMethod& method :
             {CodingMethod{"hogel", ""}, {"threepass", "cdf97"}, {"ezw", "haar"}, {"jpeg4d", "dct8"}}) {
            const LightFieldBuffer field = textured_planes(c.s, c.t, c.u, c.v, c.channels);
            CompressionOptions options = with_sqnr(method, 40);
            options.tile = HogelRange{0, 0, 4, 3};
            compress(field, folder / "a.hgl", options);
            const LightFieldBuffer other = decoded(folder / "a.hgl");
            EXPECT_EQ(other.grid(), field.grid());
            EXPECT_GE(sqnr_of(field, other), 40) << method.coder << " " << c.s << "x" << c.t << "x" << c.u;
        }
}

TEST(Compress, darkness_takes_nearly_no_bytes) {
    const TestFolder folder;
    const LightFieldBuffer dark(LightFieldGrid{4, 4, 1e-3, 8, 8, Perspective{0.3, 0.3}, 3});
    for (const CodingMethod& method : all_methods()) {
        const CompressionResult result = compress(dark, folder / "a.hgl", with_sqnr(method, 40));
        EXPECT_LT(result.bytes, 300u);
        EXPECT_EQ(result.sqnr, std::numeric_limits<double>::infinity());
        const LightFieldBuffer other = decoded(folder / "a.hgl");
        for (const float value : other.radiance.elements()) ASSERT_EQ(value, 0);
    }
}

TEST(Compress, bytes_do_not_depend_on_threads) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(9, 7, 16, 16, 3);
    for (const CodingMethod& method : {CodingMethod{"hogel", ""}, {"threepass", "cdf97"}}) {
        CompressionOptions options = with_sqnr(method, 30);
        options.tile = HogelRange{0, 0, 4, 4};
        std::vector<std::vector<std::uint8_t>> files;
        for (const std::size_t threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            compress(field, folder / "a.hgl", options);
            files.push_back(bytes_of_file(folder / "a.hgl"));
        }
        EXPECT_EQ(files[0], files[1]);
        EXPECT_EQ(files[0], files[2]);
    }
}

TEST(Compress, impossible_requests_are_refused) {
    const TestFolder folder;
    LightFieldBuffer field = textured_planes(2, 2, 4, 4, 1);
    const auto refused = [&](const CompressionOptions& options) {
        return code_of([&] { compress(field, folder / "a.hgl", options); });
    };
    EXPECT_EQ(refused(with_sqnr({"threepass", "cdf97"}, -1)), ErrorCode::usage);
    EXPECT_EQ(refused(with_sqnr({"threepass", "cdf98"}, 30)), ErrorCode::usage);
    EXPECT_EQ(refused(with_sqnr({"zip", "cdf97"}, 30)), ErrorCode::usage);
    EXPECT_EQ(refused(with_sqnr({"threepass", "dct8"}, 30)), ErrorCode::usage);
    EXPECT_EQ(refused(with_sqnr({"jpeg4d", "haar"}, 30)), ErrorCode::usage);
    EXPECT_EQ(refused(with_sqnr({"hogel", "haar"}, 30)), ErrorCode::usage);
    for (const CompressionTarget& target :
         {CompressionTarget{Sqnr{0}}, CompressionTarget{Sqnr{121}}, CompressionTarget{PixelsPerBit{-8}},
          CompressionTarget{Step{}}, CompressionTarget{Step{double(NAN)}}, CompressionTarget{MaxError{}}}) {
        CompressionOptions options;
        options.target = target;
        EXPECT_EQ(refused(options), ErrorCode::usage) << target.index();
    }
    field.radiance(0, 1, 1, 2, 3) = std::numeric_limits<float>::infinity();
    EXPECT_EQ(refused(with_sqnr({"threepass", "cdf97"}, 30)), ErrorCode::bad_input);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.hgl"));
}

// A coder that stores plain floats.
class FloatCoder final : public TileCoder {
  public:
    HogelRange preferred_tile(const LightFieldGrid&) const override { return {0, 0, 3, 2}; }
    Encoded encode(LightFieldTile& tile, double, std::size_t) const override {
        const auto values = std::as_bytes(tile.radiance.elements());
        Encoded encoded;
        for (const std::byte byte : values) encoded.bytes.push_back(static_cast<std::uint8_t>(byte));
        return encoded;
    }
    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        const auto values = std::as_writable_bytes(tile.radiance.elements());
        if (bytes.size() != values.size()) throw Error(ErrorCode::bad_input, "a wrong number of floats");
        for (std::size_t i = 0; i < bytes.size(); ++i) values[i] = std::byte{bytes[i]};
    }
};

TEST(Coders, program_adds_a_coder_of_its_own) {
    const auto make = [](const CodingMethod&, const LightFieldGrid&, const DirectionCross&) {
        return std::make_unique<FloatCoder>();
    };
    coders().add({"floats", "floats as they are", "", false, make});
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(7, 5, 8, 6, 3);
    CompressionOptions options;
    options.method.coder = "floats";
    options.target = Step{1};
    EXPECT_EQ(compress(field, folder / "a.hgl", options).sqnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(read_stream_info(folder / "a.hgl").method.coder, "floats");
    EXPECT_TRUE(std::ranges::equal(decoded(folder / "a.hgl").radiance.elements(), field.radiance.elements()));
    EXPECT_EQ(code_of([&] { coders().add({"ezw", "", "", false, make}); }), ErrorCode::usage);
}

TEST(Coders, every_row_codes_with_its_own_transform) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(4, 3, 12, 10, 1);
    for (const CoderInfo& coder : coders().rows()) {
        if (coder.name == "floats") continue;
        compress(field, folder / "a.hgl", with_sqnr({coder.name, ""}, 30));
        EXPECT_EQ(read_stream_info(folder / "a.hgl").method.transform, coder.transform);
        EXPECT_FALSE(coder.text.empty());
    }
}

TEST(Search, finds_the_band_of_a_falling_function) {
    for (const double start : {-12.0, 0.0, 3.0, 11.0}) {
        Search search(29.5, 30, start, -5.5);
        int values = 0;
        // A function with a varying slope and some noise.
        const auto value = [](double x) { return 40 - 3 * x - 0.2 * x * std::abs(x) + 0.05 * std::sin(40 * x); };
        while (!search.add(value(search.next()))) ASSERT_LT(++values, 12) << start;
        EXPECT_GE(value(search.next()), 29.5);
        EXPECT_LE(value(search.next()), 30);
    }
    // If the function jumps over the band, the search brackets the jump from both sides.
    Search search(29.5, 30, 0, -5.5);
    for (int i = 0; i < 40; ++i) search.add(search.next() < 1.25 ? 40 : 20);
    EXPECT_NEAR(search.above().value(), 1.25, 1e-3);
    EXPECT_NEAR(search.below().value(), 1.25, 1e-3);
}

}  // namespace
}  // namespace hogel::codec::encode
