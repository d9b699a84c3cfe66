// SPDX-License-Identifier: Apache-2.0
// Fields in NPY files and pictures.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string_view>

#include "hogel/core/half.h"
#include "hogel/core/part.h"
#include "hogel/image.h"
#include "hogel/io/arrays/test_field_files.h"

namespace hogel::io::arrays {
namespace {

using ExternalFields = FieldFiles;

TEST_F(ExternalFields, of_numpy_are_read_by_rows_and_by_columns) {
    expect_example(*open_external_field(write("a.npy", npy_rows()), known()));
    const Bytes columns = npy("<c16", true, [](Bytes& bytes) {
        for (int column = 0; column < 2; ++column)
            for (int row = 0; row < 3; ++row) {
                put(bytes, double(2 * row + column));
                put(bytes, double(2 * row + column + 6));
            }
    });
    const auto field = open_external_field(write("b.npy", columns), known());
    expect_example(*field);
    Array<Complex, 2> corner({2, 1});
    field->read({1, 1, 1, 2}, 0, corner);
    EXPECT_EQ(corner(1, 0), Complex(5, 11));
    ExternalField other = known();
    other.conjugate = true;
    expect_example(*open_external_field(directory_ / "b.npy", other), -1);
    EXPECT_TRUE(is_external_field(directory_ / "b.npy"));
}

TEST_F(ExternalFields, are_written_as_numpy_writes_them) {
    const auto field = open_external_field(write("a.npy", npy_rows()), known());
    write_npy(directory_ / "b.npy", all_of(*field));
    std::ifstream a(directory_ / "a.npy", std::ios::binary), b(directory_ / "b.npy", std::ios::binary);
    EXPECT_TRUE(std::equal(std::istreambuf_iterator<char>(a), {}, std::istreambuf_iterator<char>(b), {}));
}

TEST_F(ExternalFields, of_numpy_are_read_in_either_order_of_bytes_and_as_halves) {
    const Bytes little = npy_rows();
    Bytes big = npy(">c8", false, [&](Bytes& bytes) { bytes.insert(bytes.end(), little.end() - 48, little.end()); });
    ASSERT_EQ(big.size(), little.size());
    for (auto number = big.end() - 48; number != big.end(); number += 4) std::reverse(number, number + 4);
    expect_example(*open_external_field(write("b.npy", big), known()));
    for (const bool swapped : {false, true}) {
        const Bytes halves = npy(swapped ? ">f2" : "<f2", false, [&](Bytes& bytes) {
            for (const float value : {0.0f, -0.5f, 2.25f, 1024.0f, 3e-5f, 7.0f}) {
                const std::uint16_t half = core::half_of(value);
                put(bytes, static_cast<std::uint16_t>(swapped ? half >> 8 | half << 8 : half));
            }
        });
        const auto samples = all_of(*open_external_field(write("h.npy", halves), known(Values::amplitude)));
        EXPECT_EQ(samples(0, 1), Complex(-0.5f));
        EXPECT_EQ(samples(1, 1), Complex(1024));
        EXPECT_NEAR(samples(2, 0).real(), 3e-5f, 3e-8f);
    }
    EXPECT_THROW(open_external_field(write("x.npy", npy(">u1", false, [](Bytes& b) { b.resize(b.size() + 6); })),
                                     known(Values::amplitude)),
                 Error);
}

// [colour][row][column] and [row][column][colour] with three colours are three fields.
TEST_F(ExternalFields, of_numpy_may_have_three_colours) {
    const auto number = [](std::size_t colour, std::size_t row, std::size_t column) {
        return static_cast<float>(100 * colour + 10 * row + column);
    };
    const auto shaped = [&](const char* shape, const std::function<void(Bytes&)>& numbers) {
        Bytes bytes = npy("<f4", false, numbers);
        const std::string_view old = "(3, 2), }";
        const auto at = std::search(bytes.begin(), bytes.end(), old.begin(), old.end());
        EXPECT_NE(at, bytes.end());
        std::ranges::copy(std::string(shape) + ", }", at);
        return bytes;
    };
    const Bytes first = shaped("(3, 4, 5)", [&](Bytes& bytes) {
        for (std::size_t i = 0; i < 60; ++i) put(bytes, number(i / 20, i / 5 % 4, i % 5));
    });
    const Bytes last = shaped("(4, 5, 3)", [&](Bytes& bytes) {
        for (std::size_t i = 0; i < 60; ++i) put(bytes, number(i % 3, i / 15, i / 3 % 5));
    });
    for (const Bytes& bytes : {first, last}) {
        const fs::path path = write("c.npy", bytes);
        EXPECT_EQ(external_facts(path).colours, 3u);
        ExternalField what = known(Values::amplitude);
        for (what.colour = 0; what.colour < 3; ++what.colour) {
            const auto field = open_external_field(path, what);
            ASSERT_EQ(field->grid().plane.width, 5u);
            ASSERT_EQ(field->grid().plane.height, 4u);
            Array<Complex, 2> part({3, 2});
            field->read({2, 1, 2, 3}, 0, part);
            for (std::size_t y = 0; y < 3; ++y)
                for (std::size_t x = 0; x < 2; ++x) EXPECT_EQ(part(y, x), Complex(number(what.colour, y + 1, x + 2)));
        }
        EXPECT_THROW(open_external_field(path, what), Error);
    }
    EXPECT_EQ(external_facts(write("one.npy", npy_rows())).colours, 1u);
    for (const char* shape : {"(4, 1, 5)", "(2, 4, 2, 2)", "(3, 2, 2, 3)", "(60,)", "(3, 4, 6)", "(4, 5, 3", "()"})
        EXPECT_THROW(external_facts(write("bad.npy", shaped(shape, [](Bytes& b) { b.resize(b.size() + 240); }))), Error)
            << shape;
}

TEST_F(ExternalFields, of_real_numbers_are_amplitudes_or_phases_as_described) {
    const auto reals = [](const char* type, auto first) {
        return npy(type, false, [&](Bytes& bytes) {
            for (int i = 0; i < 6; ++i) put(bytes, static_cast<decltype(first)>(i));
        });
    };
    const fs::path radians = write("f.npy", reals("<f4", float())),
                   codes = write("u.npy", reals("<u2", std::uint16_t()));
    EXPECT_THROW(open_external_field(radians, known()), Error);
    EXPECT_THROW(open_external_field(write("a.npy", npy_rows()), known(Values::phase)), Error);
    const auto at = [](const fs::path& path, Values values) {
        return all_of(*open_external_field(path, known(values)))(2, 0);
    };
    EXPECT_EQ(at(radians, Values::amplitude), Complex(4));
    EXPECT_LT(std::abs(at(radians, Values::phase) - std::polar(1.0f, 4.0f)), 1e-6f);
    EXPECT_THROW(at(codes, Values::phase), Error);  // in which code?
    ExternalField coded = known(Values::phase);
    coded.phase_code = parse_phase_code("hogel");
    EXPECT_LT(std::abs(all_of(*open_external_field(codes, coded))(2, 0) -
                       std::polar(1.0f, float(2 * std::numbers::pi * 4 / 65536))),
              1e-6f);
    coded.values = Values::amplitude;
    EXPECT_THROW(open_external_field(codes, coded), Error);
}

TEST_F(ExternalFields, of_pictures_are_phases_amplitudes_or_real_and_imaginary_parts) {
    if (!core::part("pictures").built_in) {
        expect_not_built_in(write("p.png", {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}), known(Values::phase),
                            "HOGEL_PICTURES");
        return;
    }
    Array<std::uint8_t, 3> levels({3, 2, 1});
    for (std::size_t i = 0; i < 6; ++i) levels.data()[i] = static_cast<std::uint8_t>(50 * i);
    write_raw_pixels(directory_ / "p.png", levels);
    ExternalField coded = known(Values::phase);
    EXPECT_THROW(open_external_field(directory_ / "p.png", coded), Error);
    coded.phase_code = parse_phase_code("hogel");
    const auto phases = all_of(*open_external_field(directory_ / "p.png", coded));
    const auto amplitudes = all_of(*open_external_field(directory_ / "p.png", known(Values::amplitude)));
    for (std::size_t i = 0; i < 6; ++i) {
        const auto angle = static_cast<float>(2 * std::numbers::pi * 50.0 * double(i) / 256);
        EXPECT_LT(std::abs(phases.data()[i] - std::polar(1.0f, angle)), 1e-6f) << i;
        EXPECT_EQ(amplitudes.data()[i], Complex(50 * float(i))) << i;
    }
    Image real(2, 3, 1), imaginary(2, 3, 1);
    for (std::size_t i = 0; i < 6; ++i) {
        real.pixels.data()[i] = float(i);
        imaginary.pixels.data()[i] = float(i + 6);
    }
    write_image(directory_ / "r.exr", real);
    write_image(directory_ / "i.exr", imaginary);
    ExternalField what = known();
    what.imaginary = directory_ / "i.exr";
    expect_example(*open_external_field(directory_ / "r.exr", what));
    write_image(directory_ / "small.exr", Image(1, 3, 1));
    what.imaginary = directory_ / "small.exr";
    EXPECT_THROW(open_external_field(directory_ / "r.exr", what), Error);
}

}  // namespace
}  // namespace hogel::io::arrays
