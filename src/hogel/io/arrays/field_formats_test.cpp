// SPDX-License-Identifier: Apache-2.0
// Fields in NPZ, MAT, OHC, EXR and pairs of pictures: there and back, their sampling, and damage.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>

#include "hogel/core/part.h"
#include "hogel/image.h"
#include "hogel/io/arrays/mat_write.h"
#include "hogel/io/arrays/npy.h"
#include "hogel/io/arrays/test_field_files.h"
#include "hogel/io/arrays/zip.h"

namespace hogel::io::arrays {
namespace {

using FieldFormats = FieldFiles;

// 5 columns, 3 rows; no two numbers are equal, and one needs all bits of a float.
std::vector<Field> example(std::size_t colours, double pitch_y = 2e-6) {
    std::vector<Field> fields;
    for (std::size_t c = 0; c < colours; ++c) {
        Field& field = fields.emplace_back(FieldGrid{{5, 3, 2e-6, pitch_y, 0, 0}, 638e-9 - 1e-7 * double(c)});
        for (std::size_t i = 0; i < 15; ++i)
            field.samples.data()[i] = Complex(float(double(i) + 0.1 * double(c)), -float(i) / 7 + float(100 * c));
    }
    return fields;
}

void expect_equal(const FieldSource& read, const Field& written) {
    EXPECT_EQ(read.grid(), written.grid());
    const Array<Complex, 2> samples = all_of(read);
    ASSERT_EQ(samples.shape(), written.samples.shape());
    for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples.data()[i], written.samples.data()[i]) << i;
}

TEST_F(FieldFormats, hold_fields_to_the_last_bit_and_their_sampling) {
    for (const char* ending : {".npz", ".mat", ".exr"}) {
        if (std::string(ending) == ".exr" && !core::part("pictures").built_in) continue;
        for (const std::size_t colours : {1, 2, 3})
            for (const double pitch_y : {2e-6, 3e-6}) {
                const std::vector<Field> fields = example(colours, pitch_y);
                const fs::path path = directory_ / ("f" + std::string(ending));
                write_fields(path, fields, {{"software", "a test"}});
                EXPECT_TRUE(is_external_field(path));
                EXPECT_EQ(external_facts(path).colours, colours) << ending;
                ExternalField what;
                for (what.colour = 0; what.colour < colours; ++what.colour)
                    expect_equal(*open_external_field(path, what), fields[what.colour]);
                EXPECT_THROW(open_external_field(path, what), Error);
            }
    }
}

TEST_F(FieldFormats, of_numpy_arrays_hold_fields_without_their_sampling) {
    for (const std::size_t colours : {1, 2, 3}) {
        const std::vector<Field> fields = example(colours);
        write_fields(directory_ / "f.npy", fields);
        EXPECT_EQ(external_facts(directory_ / "f.npy").pitch_x, 0);
        ExternalField what;
        EXPECT_THROW(open_external_field(directory_ / "f.npy", what), Error);
        what.pitch_x = what.pitch_y = 2e-6;
        for (what.colour = 0; what.colour < colours; ++what.colour) {
            what.wavelength = fields[what.colour].grid().wavelength;
            expect_equal(*open_external_field(directory_ / "f.npy", what), fields[what.colour]);
        }
    }
}

TEST_F(FieldFormats, refuse_a_sample_that_is_not_finite_by_place) {
    for (const char* ending : {".npy", ".npz", ".mat", ".exr"}) {
        if (std::string(ending) == ".exr" && !core::part("pictures").built_in) continue;
        std::vector<Field> fields = example(3);
        fields[1].samples(2, 4) = Complex(1, std::numeric_limits<float>::infinity());
        const fs::path path = directory_ / ("f" + std::string(ending));
        write_fields(path, fields);
        ExternalField what;
        what.pitch_x = what.pitch_y = std::string(ending) == ".npy" ? 2e-6 : 0;
        what.wavelength = std::string(ending) == ".npy" ? 532e-9 : 0;
        for (what.colour = 0; what.colour < 3; ++what.colour) try {
                all_of(*open_external_field(path, what));
                EXPECT_NE(what.colour, 1u) << ending;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::bad_input);
                EXPECT_NE(std::string(error.what()).find("f" + std::string(ending)), std::string::npos) << error.what();
                EXPECT_NE(std::string(error.what()).find("row 2 and column 4 of its field 1, from 0, is 1+infi"),
                          std::string::npos)
                    << error.what();
            }
    }
}

TEST_F(FieldFormats, are_told_by_the_ending_alone) {
    const std::vector<Field> fields = example(1);
    for (const char* name : {"f.h5", "f.png", "f", "f.npyx"}) {
        EXPECT_THROW(write_fields(directory_ / name, fields), Error) << name;
        EXPECT_FALSE(fs::exists(directory_ / name));
    }
    std::vector<Field> two = example(2);
    two[1] = Field({{4, 3, 2e-6, 2e-6, 0, 0}, 5e-7});
    EXPECT_THROW(write_fields(directory_ / "f.npz", two), Error);
}

Bytes npy_of(const std::vector<double>& values, const std::vector<std::size_t>& shape) {
    const std::string start = npy_beginning("<f8", shape);
    Bytes bytes(start.begin(), start.end());
    const auto* first = reinterpret_cast<const unsigned char*>(values.data());
    bytes.insert(bytes.end(), first, first + values.size() * sizeof(double));
    return bytes;
}

using Members = std::vector<std::pair<std::string, Bytes>>;
Bytes npz_of(const Members& members) {
    ZipWriter zip("x.npz");
    for (const auto& [name, bytes] : members) zip.add(name + ".npy", bytes);
    return zip.finish();
}

// Two real arrays form a field if their names denote its parts.
TEST_F(FieldFormats, of_several_arrays_are_joined_by_their_names) {
    const Bytes a = npy_of({1, 2, 3, 4}, {2, 2}), b = npy_of({5, 6, 7, 8}, {2, 2});
    const Bytes pitch = npy_of({8e-6}, {}), wave = npy_of({532}, {1});
    const auto first_of = [&](const char* one, const char* two, const std::string& variable = "") {
        ExternalField what;
        what.variable = variable;
        return all_of(*open_external_field(
            write("p.npz", npz_of({{"target", npy_of({9}, {1})}, {two, b}, {one, a}, {"pp", pitch}, {"wav_nm", wave}})),
            what))(0, 1);
    };
    EXPECT_EQ(first_of("real", "imag"), Complex(2, 6));
    EXPECT_EQ(first_of("holo_re", "holo_im"), Complex(2, 6));
    EXPECT_EQ(first_of("IM_H", "RE_H"), Complex(6, 2));
    EXPECT_LT(std::abs(first_of("amp", "phs") - std::polar(2.0f, 6.0f)), 1e-6f);
    EXPECT_EQ(first_of("u", "v", "v,u"), Complex(6, 2));
    EXPECT_THROW(first_of("u", "v"), Error);
    EXPECT_THROW(first_of("a_re", "b_im"), Error);
    EXPECT_THROW(first_of("u", "v", "u,w"), Error);
    const ExternalFacts facts = external_facts(directory_ / "p.npz", {.variable = "u"});
    EXPECT_EQ(facts.pitch_x, 8e-6);
    ASSERT_EQ(facts.wavelengths.size(), 1u);
    EXPECT_NEAR(facts.wavelengths[0], 532e-9, 1e-15);
}

TEST_F(FieldFormats, of_a_complex_array_beside_real_ones_is_that_array) {
    const std::string start = npy_beginning("<c8", std::vector<std::size_t>{1, 4});
    Bytes field(start.begin(), start.end());
    field.resize(field.size() + 32);
    const auto path = write("t.npz", npz_of({{"target", npy_of({1, 2, 3, 4}, {2, 2})}, {"h", field}}));
    EXPECT_EQ(external_facts(path).width, 4u);
}

// Implausible lengths in metres are not used.
TEST_F(FieldFormats, with_parameters_that_are_no_lengths_in_metres_complain) {
    const Bytes samples = npy_of({1, 2, 3, 4}, {2, 2});
    for (const double wave : {532.0, 0.0, -5e-7, std::nan(""), 1e-12}) {
        const auto path = write("w.npz", npz_of({{"h", samples}, {"lambda", npy_of({wave}, {})}}));
        const ExternalFacts facts = external_facts(path);
        EXPECT_TRUE(facts.wavelengths.empty()) << wave;
        EXPECT_NE(facts.complaint.find("lambda"), std::string::npos) << facts.complaint;
        ExternalField what{
            .pitch_x = 1e-6, .pitch_y = 1e-6, .wavelength = 5e-7, .values = ExternalField::Values::amplitude};
        EXPECT_EQ(open_external_field(path, what)->grid().wavelength, 5e-7);  // the description is believed
    }
    const auto two =
        write("d.npz", npz_of({{"h", samples}, {"dx", npy_of({4e-6}, {1, 1})}, {"dy", npy_of({5e-6}, {})}}));
    EXPECT_EQ(external_facts(two).pitch_x, 4e-6);
    EXPECT_EQ(external_facts(two).pitch_y, 5e-6);
    const auto many = write("m.npz", npz_of({{"h", samples}, {"wavelengths", npy_of({6e-7, 5e-7, 4e-7}, {3})}}));
    EXPECT_TRUE(external_facts(many).wavelengths.empty());  // three for one field
}

// The bytes of OpenHolo's format, by its published structures.
struct Ohc {
    std::uint32_t width = 3, height = 2;
    unsigned char unit = 4, wave_unit = 5, arrangement = 2, type = 10, parts = 2;
    std::vector<double> waves{638, 520};
};
Bytes ohc(const Ohc& file, const std::vector<double>& numbers) {
    Bytes bytes{'O', 'H'};
    const auto begin = static_cast<std::uint32_t>(24 + 65 + 8 * file.waves.size());
    put(bytes, std::uint64_t{begin + numbers.size() * (file.type == 10 ? 8 : 4)});
    put(bytes, std::uint16_t{5});
    put(bytes, std::uint64_t{0});
    put(bytes, begin);
    put(bytes, std::uint32_t{begin - 24});
    put(bytes, file.width);
    put(bytes, file.height);
    put(bytes, 8.0);
    put(bytes, 7.0);
    bytes.push_back(file.unit);
    put(bytes, static_cast<std::uint32_t>(file.waves.size()));
    for (const unsigned char byte : {static_cast<unsigned char>(2), file.arrangement, file.wave_unit, file.type,
                                     static_cast<unsigned char>(1), file.parts, static_cast<unsigned char>(0)})
        bytes.push_back(byte);
    put(bytes, -1.0);
    put(bytes, 1.0);
    put(bytes, std::uint64_t{0});
    bytes.push_back(0);
    for (const double wave : file.waves) put(bytes, wave);
    for (const double number : numbers)
        if (file.type == 10)
            put(bytes, number);
        else
            put(bytes, static_cast<float>(number));
    return bytes;
}

TEST_F(FieldFormats, of_openholo_are_read_in_every_arrangement) {
    std::vector<double> numbers;
    for (int i = 0; i < 24; ++i) numbers.push_back(i);
    Ohc file;
    ExternalField second;
    second.colour = 1;
    const auto field = open_external_field(write("a.ohc", ohc(file, numbers)), second);
    EXPECT_EQ(field->grid().plane.width, 3u);
    EXPECT_EQ(field->grid().plane.height, 2u);
    EXPECT_NEAR(field->grid().plane.pitch_x, 8e-6, 1e-15);
    EXPECT_NEAR(field->grid().plane.pitch_y, 7e-6, 1e-15);
    EXPECT_NEAR(field->grid().wavelength, 520e-9, 1e-15);
    // Field by field: the second begins at number 6, its imaginary parts at 12 + 6; row 1, column 2 is number 5.
    EXPECT_EQ(all_of(*field)(1, 2), Complex(11, 23));
    file.arrangement = 1;  // the wavelengths of a sample side by side
    EXPECT_EQ(all_of(*open_external_field(write("b.ohc", ohc(file, numbers)), second))(1, 2), Complex(11, 23));
    EXPECT_EQ(all_of(*open_external_field(directory_ / "b.ohc", second))(0, 1), Complex(3, 15));
    file.type = 9;
    file.parts = 1;
    EXPECT_LT(std::abs(all_of(*open_external_field(write("c.ohc", ohc(file, numbers)), second))(0, 1) -
                       std::polar(3.0f, 15.0f)),
              1e-5f);
    file.parts = 4;
    file.waves = {5.32e-7};
    file.wave_unit = 0;
    numbers.resize(6);
    EXPECT_LT(
        std::abs(all_of(*open_external_field(write("d.ohc", ohc(file, numbers)), {}))(1, 0) - std::polar(1.0f, 3.0f)),
        1e-6f);
    file.parts = 3;
    EXPECT_EQ(all_of(*open_external_field(write("e.ohc", ohc(file, numbers)), {}))(1, 0), Complex(3));
    file.parts = 5;
    EXPECT_THROW(open_external_field(write("x.ohc", ohc(file, numbers)), {}), Error);
}

TEST_F(FieldFormats, of_two_pictures_of_levels_have_their_zero_at_the_median_or_where_it_is_said) {
    if (without_pictures()) return;
    Array<std::uint8_t, 3> real({3, 3, 1}), imaginary({3, 3, 1});
    for (std::size_t i = 0; i < 9; ++i) {
        real.data()[i] = static_cast<std::uint8_t>(100 + 10 * i);
        imaginary.data()[i] = static_cast<std::uint8_t>(8 - i);
    }
    write_raw_pixels(directory_ / "r.png", real);
    write_raw_pixels(directory_ / "i.bmp", imaginary);
    ExternalField what{.pitch_x = 1e-6, .pitch_y = 1e-6, .wavelength = 5e-7};
    what.imaginary = directory_ / "i.bmp";
    EXPECT_EQ(all_of(*open_external_field(directory_ / "r.png", what))(2, 2), Complex(40, -4));
    what.zero = 128;
    EXPECT_EQ(all_of(*open_external_field(directory_ / "r.png", what))(2, 2), Complex(52, -128));
    what.imaginary.clear();
    EXPECT_THROW(open_external_field(directory_ / "r.png", what), Error);
    what.zero.reset();
    what.phases = directory_ / "i.bmp";
    EXPECT_THROW(open_external_field(directory_ / "r.png", what), Error);  // in which code?
    what.phase_code = parse_phase_code("odak");
    const Complex sample = all_of(*open_external_field(directory_ / "r.png", what))(0, 0);
    EXPECT_LT(std::abs(sample - std::polar(100.0f, float(2 * std::numbers::pi * 8 / 255))), 1e-4f);
}

// A picture with the texts of field_entries() needs no description; a description takes precedence.
TEST_F(FieldFormats, of_pictures_that_say_what_they_are_need_no_description) {
    if (without_pictures()) return;
    Array<std::uint8_t, 3> levels({2, 2, 3});
    for (std::size_t i = 0; i < 12; ++i) levels.data()[i] = static_cast<std::uint8_t>(20 * i);
    const std::vector<double> waves{638e-9, 520.25e-9, 450e-9};
    const PhaseCode codes[] = {parse_phase_code("slmsuite"), {5, -1, true, true}, {4, 0.5, false, false}};
    for (const PhaseCode& code : codes) {
        ExternalField what{.pitch_x = 3.74e-6, .pitch_y = 3.74e-6, .values = ExternalField::Values::phase};
        what.phase_code = code;
        write_raw_pixels(directory_ / "p.png", levels, field_entries(what, waves));
        EXPECT_TRUE(is_external_field(directory_ / "p.png"));
        EXPECT_EQ(external_facts(directory_ / "p.png").values, "phase");
        for (std::size_t c = 0; c < 3; ++c) {
            ExternalField colour{.colour = c};
            const auto field = open_external_field(directory_ / "p.png", colour);
            EXPECT_EQ(field->grid(), (FieldGrid{{2, 2, 3.74e-6, 3.74e-6, 0, 0}, waves[c]}));
            const auto phase = static_cast<float>(code.phase(20.0 * double(9 + c), 255));
            EXPECT_LT(std::abs(all_of(*field)(1, 1) - std::polar(1.0f, phase)), 1e-5f);
        }
    }
    ExternalField said{.pitch_x = 8e-6, .pitch_y = 8e-6, .wavelength = 532e-9};
    said.values = ExternalField::Values::amplitude;
    const auto field = open_external_field(directory_ / "p.png", said);
    EXPECT_EQ(field->grid(), (FieldGrid{{2, 2, 8e-6, 8e-6, 0, 0}, 532e-9}));
    EXPECT_EQ(all_of(*field)(1, 1), Complex(180));
    // A pattern of amplitudes, and a BMP file, which has no texts.
    write_raw_pixels(directory_ / "a.png", levels, field_entries(said, waves));
    EXPECT_EQ(all_of(*open_external_field(directory_ / "a.png", {}))(1, 1), Complex(180));
    write_raw_pixels(directory_ / "a.bmp", levels, field_entries(said, waves));
    EXPECT_FALSE(is_external_field(directory_ / "a.bmp"));
    // Texts of strangers.
    for (const auto& [name, text] : Metadata{{"phase_code", "unknown"}, {"values", "other"}, {"pitch_x_m", "-1"}}) {
        ExternalField what{.pitch_x = 1e-6, .pitch_y = 1e-6, .values = ExternalField::Values::phase};
        what.phase_code = codes[0];
        Metadata entries = field_entries(what, waves);
        for (auto& [key, value] : entries)
            if (key == name) value = text;
        write_raw_pixels(directory_ / "s.png", levels, entries);
        EXPECT_THROW(open_external_field(directory_ / "s.png", {}), Error) << name;
    }
}

TEST_F(FieldFormats, of_a_picture_whose_colours_differ_are_three) {
    if (without_pictures()) return;
    Array<std::uint8_t, 3> levels({2, 2, 3});
    for (std::size_t i = 0; i < 12; ++i) levels.data()[i] = static_cast<std::uint8_t>(20 * i);
    write_raw_pixels(directory_ / "c.png", levels);
    ExternalField what{.pitch_x = 1e-6, .pitch_y = 1e-6, .wavelength = 5e-7, .values = ExternalField::Values::phase};
    what.phase_code = parse_phase_code("slmsuite");
    EXPECT_EQ(external_facts(directory_ / "c.png", what).colours, 3u);
    for (what.colour = 0; what.colour < 3; ++what.colour) {
        const auto angle = 2 * std::numbers::pi * (255 - 20.0 * double(9 + what.colour)) / 256;
        EXPECT_LT(
            std::abs(all_of(*open_external_field(directory_ / "c.png", what))(1, 1) - std::polar(1.0f, float(angle))),
            1e-5f);
    }
    for (std::size_t i = 0; i < 12; ++i) levels.data()[i] = static_cast<std::uint8_t>(i / 3);
    write_raw_pixels(directory_ / "g.png", levels);
    EXPECT_EQ(external_facts(directory_ / "g.png", what).colours, 1u);
}

// A damaged file is refused, or read as some field.
void attempt(const fs::path& path, const Bytes& bytes, std::size_t& refused) {
    {
        fs::remove(path);
        std::ofstream file(path, std::ios::binary);
        file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    ExternalField what{.pitch_x = 1e-6, .pitch_y = 1e-6, .wavelength = 5e-7};
    try {
        const auto field = open_external_field(path, what);
        ASSERT_LE(field->grid().plane.samples(), 100000u);
        all_of(*field);
    } catch (const Error& error) {
        ASSERT_TRUE(error.code() == ErrorCode::bad_input || error.code() == ErrorCode::usage ||
                    error.code() == ErrorCode::not_built_in)
            << error.what();
        ++refused;
    }
}

TEST_F(FieldFormats, in_damaged_files_are_refused_or_read) {
    write_fields(directory_ / "f.npz", example(1));
    write_fields(directory_ / "f.mat", example(1));
    std::vector<fs::path> names{directory_ / "f.npz", directory_ / "f.mat",
                                write("f.ohc", ohc(Ohc(), std::vector<double>(24, 1.5)))};
    if (core::part("pictures").built_in) {
        write_fields(directory_ / "f.exr", example(1));
        names.push_back(directory_ / "f.exr");
    }
    for (const fs::path& name : names) {
        std::ifstream file(name, std::ios::binary);
        const std::vector<char> read{std::istreambuf_iterator<char>(file), {}};
        const Bytes whole(read.begin(), read.end());
        std::size_t refused = 0, cut = 0;
        for (std::size_t length = 1; length < whole.size(); ++length, ++cut)
            attempt(directory_ / ("x" + name.extension().string()),
                    Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)), refused);
        // A MAT file whose last, small variables are cut off still holds its field.
        EXPECT_GE(refused, name.extension() == ".mat" ? cut / 2 : cut) << name;
        for (std::size_t at = 0; at < whole.size(); ++at) {
            Bytes damaged = whole;
            constexpr int flips[] = {0x01, 0x80, 0xff};
            damaged[at] = static_cast<unsigned char>(damaged[at] ^ flips[at % 3]);
            attempt(directory_ / ("x" + name.extension().string()), damaged, refused);
        }
    }
}

}  // namespace
}  // namespace hogel::io::arrays
