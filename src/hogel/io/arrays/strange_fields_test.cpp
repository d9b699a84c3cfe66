// SPDX-License-Identifier: Apache-2.0
// Fields of other programs: axes in any order, pairs of real numbers, parameters of many names, and arrays that only
// look like fields.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

#include "hogel/core/part.h"
#include "hogel/core/test_errors.h"
#include "hogel/image/channels.h"
#include "hogel/io/arrays/mat_write.h"
#include "hogel/io/arrays/named_arrays.h"
#include "hogel/io/arrays/npy.h"
#include "hogel/io/arrays/test_field_files.h"
#include "hogel/io/arrays/zip.h"

namespace hogel::io::arrays {
namespace {

using StrangeFields = FieldFiles;

constexpr std::size_t height = 4, width = 5;

double number(std::size_t colour, std::size_t y, std::size_t x, std::size_t part) {
    return double(1000 * colour + 100 * part + 10 * y + x + 1);
}

// An array whose axes are 1, c (colours), y, x and p (two real numbers), the last the fastest.
Bytes arranged(const std::string& axes, std::size_t colours) {
    const bool complex = axes.find('p') == std::string::npos;
    const auto extent = [&](char axis) -> std::size_t {
        return axis == 'c' ? colours : axis == 'y' ? height : axis == 'x' ? width : axis == 'p' ? 2 : 1;
    };
    std::vector<std::size_t> shape;
    std::size_t count = 1;
    for (const char axis : axes) shape.push_back(extent(axis)), count *= extent(axis);
    const std::string start = npy_beginning(complex ? "<c8" : "<f4", shape);
    Bytes bytes(start.begin(), start.end());
    for (std::size_t i = 0; i < count; ++i) {
        std::map<char, std::size_t> at;
        std::size_t rest = i;
        for (std::size_t a = axes.size(); a-- > 0; rest /= extent(axes[a])) at[axes[a]] = rest % extent(axes[a]);
        put(bytes, float(number(at['c'], at['y'], at['x'], at['p'])));
        if (complex) put(bytes, float(number(at['c'], at['y'], at['x'], 1)));
    }
    return bytes;
}

using StrangeMembers = std::vector<std::pair<std::string, Bytes>>;
Bytes npz(const StrangeMembers& members) {
    ZipWriter zip("x.npz");
    for (const auto& [name, bytes] : members) zip.add(name + ".npy", bytes);
    return zip.finish();
}

Bytes strange_npy(const std::vector<double>& values, const std::vector<std::size_t>& shape) {
    const std::string start = npy_beginning("<f8", shape);
    Bytes bytes(start.begin(), start.end());
    for (const double value : values) put(bytes, value);
    return bytes;
}

void expect_arranged(const fs::path& path, ExternalField what, std::size_t colours, const std::string& axes) {
    ASSERT_EQ(external_facts(path).colours, colours) << axes;
    for (what.colour = 0; what.colour < colours; ++what.colour) {
        const Array<Complex, 2> samples = all_of(*open_external_field(path, what));
        ASSERT_EQ(samples.shape(), (Shape<2>{height, width})) << axes;
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x)
                ASSERT_EQ(samples(y, x),
                          Complex(float(number(what.colour, y, x, 0)), float(number(what.colour, y, x, 1))))
                    << axes << " " << path;
    }
}

// All pairs of names used to be compared.
TEST(PartNames, are_paired_in_linear_time) {
    std::vector<PartName> names;
    for (std::size_t i = 0; i < 50000; ++i) {
        names.push_back({fmt::format("a{}_re", i), "3x4"});
        names.push_back({fmt::format("a{}_im", i), i % 10000 == 0 ? "3x4" : "4x3"});
    }
    const std::vector<PartPair> pairs = pairs_of_parts(names, names.size());
    ASSERT_EQ(pairs.size(), 5u);
    EXPECT_EQ(pairs[1].first, 20000u);
    EXPECT_EQ(pairs[1].second, 20001u);
    std::vector<PartName> same;
    for (std::size_t i = 0; i < 50000; ++i) same.push_back({i % 2 == 0 ? "amp" : "phase", ""});
    EXPECT_EQ(pairs_of_parts(same, 2).size(), 2u);
    EXPECT_EQ(pairs_of_parts(same, 2)[0].content, Content::amplitude_phase);
}

// All of them would be unpacked.
TEST(ZipArchive, files_that_share_their_bytes_are_refused) {
    ZipWriter zip("x.npz");
    zip.add("a.npy", Bytes(1000));
    Bytes archive = zip.finish();
    const std::size_t end = archive.size() - 22, begin = end - (46 + 5);
    const Bytes entry(archive.begin() + static_cast<long>(begin), archive.begin() + static_cast<long>(end));
    for (int i = 0; i < 2; ++i) archive.insert(archive.begin() + static_cast<long>(begin), entry.begin(), entry.end());
    archive[archive.size() - 22 + 10] = 3;
    EXPECT_EQ(core::code_of([&] { read_zip("x.npz", archive); }), ErrorCode::bad_input);
    archive[archive.size() - 22 + 10] = 1;
    EXPECT_EQ(read_zip("x.npz", archive).size(), 1u);
}

TEST_F(StrangeFields, have_their_axes_in_many_orders) {
    for (const char* axes : {"yx", "1yx", "yx1", "11yx", "cyx", "yxc", "1cyx", "cyx1", "1yxc", "yxp", "pyx", "11yxp",
                             "1pyx", "cyxp", "pcyx", "yxcp", "pyxc", "1cyxp"}) {
        const std::string_view view(axes);
        const bool pairs = view.find('p') != view.npos, coloured = view.find('c') != view.npos;
        for (const std::size_t colours : {2, 3}) {
            if (colours == 2 && (pairs || !coloured)) continue;  // two real planes are parts
            const Bytes bytes = arranged(axes, colours);
            const ExternalField what = known(pairs ? Values::real_imaginary : Values::complex);
            expect_arranged(write("a.npy", bytes), what, coloured ? colours : 1, axes);
            expect_arranged(write("a.npz", npz({{"arr_0", bytes}})), what, coloured ? colours : 1, axes);
        }
    }
}

void expect_refused(const fs::path& path, const ExternalField& what, ErrorCode code, const std::string& words) {
    try {
        all_of(*open_external_field(path, what));
        ADD_FAILURE() << path << " was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST_F(StrangeFields, of_pairs_are_what_is_said) {
    const fs::path pairs = write("p.npy", arranged("yxp", 1)), one = write("f.npy", strange_npy({1, 2, 3, 4}, {2, 2})),
                   complex = write("c.npy", arranged("yx", 1));
    const Complex sample = all_of(*open_external_field(pairs, known(Values::amplitude_phase)))(1, 2);
    EXPECT_LT(std::abs(sample - Complex(std::polar(number(0, 1, 2, 0), number(0, 1, 2, 1)))), 1e-5f);
    EXPECT_NE(external_facts(pairs).numbers.find("pairs"), std::string::npos);
    for (const Values values : {Values::complex, Values::amplitude, Values::phase})
        expect_refused(pairs, known(values), ErrorCode::usage, "pairs of real numbers");
    expect_refused(one, known(Values::real_imaginary), ErrorCode::usage, "not pairs of");
    expect_refused(complex, known(Values::amplitude_phase), ErrorCode::usage, "holds complex numbers");
}

// Levels without a known maximum would be read as wrong phases.
TEST_F(StrangeFields, of_levels_that_lost_their_type_are_refused) {
    ExternalField coded = known(Values::phase);
    coded.phase_code = parse_phase_code("odak");
    expect_refused(write("f.npy", strange_npy({0, 128, 200, 255}, {2, 2})), coded, ErrorCode::bad_input, "from 0 to 1");
    const auto whole = [&](const char* type, auto first) {
        const std::string start = npy_beginning(type, std::vector<std::size_t>{2, 2});
        Bytes bytes(start.begin(), start.end());
        for (int i = 0; i < 4; ++i) put(bytes, static_cast<decltype(first)>(i));
        return write("w.npy", bytes);
    };
    expect_refused(whole("<i8", std::int64_t()), coded, ErrorCode::bad_input, "uint8");
    expect_refused(whole("<i2", std::int16_t()), coded, ErrorCode::bad_input, "uint8");
    // With two levels, black is no phase and white half a turn.
    coded.phase_code = parse_phase_code("hogel");
    const std::string start = npy_beginning("|b1", std::vector<std::size_t>{1, 2});
    Bytes bits(start.begin(), start.end());
    bits.insert(bits.end(), {0, 1});
    const Array<Complex, 2> samples = all_of(*open_external_field(write("b.npy", bits), coded));
    EXPECT_LT(std::abs(samples(0, 0) - 1.0f), 1e-6f);
    EXPECT_LT(std::abs(samples(0, 1) + 1.0f), 1e-6f);
}

TEST_F(StrangeFields, have_parameters_of_many_names) {
    const Bytes samples = arranged("yx", 1);
    for (const auto& [name, value] :
         {std::pair("dx", 8e-6), std::pair("pixel_pitch", 8e-6), std::pair("PixelSize_um", 8.0),
          std::pair("pitch_mm", 0.008), std::pair("pixelPitchUm", 8.0), std::pair("dx_nm", 8000.0),
          std::pair("sample_spacing", 8e-6)})
        EXPECT_NEAR(external_facts(write("p.npz", npz({{"u", samples}, {name, strange_npy({value}, {})}}))).pitch_x,
                    8e-6, 1e-15)
            << name;
    for (const auto& [name, value] :
         {std::pair("lambda", 532e-9), std::pair("wavelength_nm", 532.0), std::pair("wlen", 532e-9),
          std::pair("lambda0", 532e-9), std::pair("wavelengthNm", 532.0), std::pair("lam_um", 0.532),
          std::pair("wl", 532e-9)}) {
        const ExternalFacts facts =
            external_facts(write("w.npz", npz({{"u", samples}, {name, strange_npy({value}, {1})}})));
        ASSERT_EQ(facts.wavelengths.size(), 1u) << name;
        EXPECT_NEAR(facts.wavelengths[0], 532e-9, 1e-15) << name;
    }
    // Millimetres and micrometres without a unit in the name are not metres; other variables are no parameters.
    for (const auto& [name, value] :
         {std::pair("lambda", 0.000532), std::pair("lambda", 0.532), std::pair("dx", 0.008), std::pair("pitch", 8.0)}) {
        const ExternalFacts facts =
            external_facts(write("x.npz", npz({{"u", samples}, {name, strange_npy({value}, {})}})));
        EXPECT_TRUE(facts.wavelengths.empty() && facts.pitch_x == 0) << name << " " << value;
        EXPECT_NE(facts.complaint.find(name), std::string::npos) << facts.complaint;
    }
    EXPECT_TRUE(external_facts(
                    write("y.npz", npz({{"u", samples}, {"m", strange_npy({1}, {})}, {"room", strange_npy({1}, {})}})))
                    .complaint.empty());
}

// A data set with a single pair of arrays named as parts.
TEST_F(StrangeFields, are_found_among_pictures) {
    const auto plane = [](double value) { return strange_npy({value, value, value, value}, {2, 2}); };
    const fs::path path =
        write("t.npz", npz({{"img", plane(9)}, {"amp", plane(2)}, {"depth", plane(8)}, {"phs", plane(0.5)}}));
    EXPECT_LT(std::abs(all_of(*open_external_field(path, known()))(0, 1) - std::polar(2.0f, 0.5f)), 1e-6f);
    const fs::path two =
        write("u.npz", npz({{"amp", plane(2)}, {"phs", plane(1)}, {"re", plane(2)}, {"im", plane(3)}}));
    expect_refused(two, known(), ErrorCode::usage, "which one is meant");
}

TEST_F(StrangeFields, of_matlab_may_be_pairs_behind_rows_and_columns) {
    std::vector<float> numbers;
    for (std::size_t part = 0; part < 2; ++part)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t y = 0; y < height; ++y) numbers.push_back(float(number(0, y, x, part)));
    MatWriter writer(directory_ / "p.mat");
    writer.array("H", std::vector<std::size_t>{height, width, 2}, numbers, {});
    const std::vector<unsigned char> bytes = writer.bytes();
    expect_arranged(write("p.mat", bytes), known(Values::real_imaginary), 1, "yxp of MATLAB");
}

TEST_F(StrangeFields, in_exr_files_are_named_before_or_after_their_colour) {
    if (without_pictures()) return;
    const auto written = [&](const std::vector<std::string>& names) {
        image::NamedChannels picture;
        for (std::size_t i = 0; i < names.size(); ++i) {
            picture.channels.emplace_back(names[i], Array<float, 2>({2, 2}));
            for (float& value : picture.channels.back().second.elements()) value = float(i + 1);
        }
        image::write_named_channels(directory_ / "x.exr", picture);
        return directory_ / "x.exr";
    };
    const auto first_of = [&](const fs::path& path, std::size_t colour) {
        ExternalField what = known();
        what.colour = colour;
        return all_of(*open_external_field(path, what))(0, 0);
    };
    // Red, green and blue in this order, wherever their letter is.
    fs::path path = written({"real.R", "real.G", "real.B", "imag.R", "imag.G", "imag.B"});
    EXPECT_EQ(first_of(path, 0), Complex(1, 4));
    EXPECT_EQ(first_of(path, 1), Complex(2, 5));
    EXPECT_EQ(first_of(path, 2), Complex(3, 6));
    path = written({"R.re", "B.re", "R.im", "B.im"});
    EXPECT_EQ(first_of(path, 0), Complex(1, 3));
    EXPECT_EQ(first_of(path, 1), Complex(2, 4));
    // Letters that name colours in pictures name parts where there is nothing else.
    EXPECT_LT(std::abs(first_of(written({"A", "P"}), 0) - std::polar(1.0f, 2.0f)), 1e-6f);
    EXPECT_EQ(first_of(written({"R", "I"}), 0), Complex(1, 2));
    EXPECT_FALSE(is_external_field(written({"R", "G", "B", "A"})));
    EXPECT_FALSE(is_external_field(written({"Y", "A"})));
}

}  // namespace
}  // namespace hogel::io::arrays
