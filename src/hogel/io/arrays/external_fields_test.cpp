// SPDX-License-Identifier: Apache-2.0
#include "hogel/files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <span>
#include <string_view>

#include "hogel/core/half.h"
#include "hogel/core/output_file.h"
#include "hogel/core/part.h"
#include "hogel/error.h"
#include "hogel/image.h"

namespace hogel::io::arrays {
namespace {

namespace fs = std::filesystem;
using Complex = std::complex<float>;
using Bytes = std::vector<unsigned char>;
using Values = ExternalField::Values;

class ExternalFields : public testing::Test {
  protected:
    ExternalFields() { fs::create_directories(directory_); }
    ~ExternalFields() override { fs::remove_all(directory_); }

    fs::path write(const char* name, const Bytes& bytes) const {
        core::write_file(directory_ / name, bytes);
        return directory_ / name;
    }

    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_external_" + std::to_string(::getpid()));
};

ExternalField known(Values values = Values::complex) {
    ExternalField what;
    what.pitch_x = what.pitch_y = 2e-6;
    what.wavelength = 633e-9;
    what.values = values;
    return what;
}

Array<Complex, 2> all_of(const FieldSource& field) {
    const Grid& plane = field.grid().plane;
    Array<Complex, 2> samples({plane.height, plane.width});
    field.read({0, 0, plane.width, plane.height}, 0, samples);
    return samples;
}

// Bytes as hexadecimal digits; zN. stands for N zeros.
Bytes from_hex(std::string_view hex) {
    Bytes bytes;
    const auto number = [&](std::size_t at, std::size_t digits) {
        return std::stoul(std::string(hex.substr(at, digits)), nullptr, 16);
    };
    for (std::size_t i = 0; i < hex.size();) {
        if (hex[i] == 'z') {
            const std::size_t end = hex.find('.', i);
            bytes.insert(bytes.end(), number(i + 1, end - i - 1), 0);
            i = end + 1;
        } else {
            bytes.push_back(static_cast<unsigned char>(number(i, 2)));
            i += 2;
        }
    }
    return bytes;
}

// Three rows of two columns, 0 + 6i, 1 + 7i, 2 + 8i, … row by row, as written by scipy 1.10.
Bytes mat(std::string_view elements) {
    constexpr std::string_view text = "MATLAB 5.0 MAT-file", end{"\0\1IM", 4};
    Bytes bytes(128, ' ');
    std::ranges::copy(text, bytes.begin());
    std::ranges::copy(end, bytes.begin() + 124);
    const Bytes rest = from_hex(elements);
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
}
const Bytes& plain_mat() {
    static const Bytes bytes =
        mat("0e000000a0000000060000000800000006080000000000000500000008000000030000000200000001000000050000006669656c64"
            "000000"
            "0900000030000000000000000000000000000000000000400000000000001040000000000000f03f00000000000008400000000000"
            "001440"
            "09000000300000000000000000001840000000000000204000000000000024400000000000001c4000000000000022400000000000"
            "002640");
    return bytes;
}
const Bytes& compressed_mat() {  // with a wavelength beside the array
    static const Bytes bytes =
        mat("0f0000004d000000789ce36360605800c46c40cc01a2410410b042f9cc40cc04c48c50b1b4ccd49c1420cd09c4060c18c001420940"
            "e90ff6"
            "109a03ca177140d52701155780d22a505a064a2b41693507007ada07f40f00000034000000789ce3636060f000623620e680d220c0"
            "0ae533"
            "22612e202e4f2c4bcd49cd4b2fc980a8e384aaf36669d9916bbbd40e00a5d907e3");
    return bytes;
}
const Bytes& two_arrays_mat() {
    static const Bytes bytes = mat(
        "0f00000049000000789ce36360609801c46c40cc01a2410410b042f9cc40cc04c48c409808a43981d88001033840280128fdc11e427340"
        "f9220ea8fa24a0e20a505a054acb40692528ade60000ab2006450f00000036000000789ce36360604800623620e680d220c00ae5330331"
        "13103302611290e6046203060ce000a104a0f4077b08cd01e58b380000836d038d");
    return bytes;
}

// The same array in HDF5 behind MATLAB's header, as written by h5py 3.7: contiguous, and compressed in chunks with a
// wavelength beside it.
Bytes mat73(std::string_view elements) {
    constexpr std::string_view text = "MATLAB 7.3 MAT-file", end{"\0\2IM", 4};
    Bytes bytes(128, ' ');
    std::ranges::copy(text, bytes.begin());
    std::ranges::copy(end, bytes.begin() + 124);
    bytes.resize(512);
    const Bytes rest = from_hex(elements);
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
}
const Bytes& plain_mat73() {
    static const Bytes bytes = mat73(
        "894844460d0a1a0az5.080800040010z6.02z6.ffffffffffffffff600az6.ffffffffffffffffz8.60z7.01z7.88z7.a8"
        "02z6.010001000100000018z7.110010z5.88z7.a802z6.5452454500000100ffffffffffffffffffffffffffffffffz8."
        "3004z6.08z1f7.48454150z4.58z7.10z7.c802ze.6669656c6400000001z7.48z3f.0100060001z4.01z6.010028z5.01"
        "0201z5.02z7.03z7.02z7.03z7.030080000100000016020000100000007265616cz24.11203f0008z5.4000340b0034ff"
        "030000696d6167z4.08z1f.11203f0008z5.4000340b0034ff030000050008000100000002020201z4.080018z5.030100"
        "08z6.60zd.100010z5.7805z6.38z7.534e4f440100010008z7.2003z136.0c0030z5.01000d00080008004d41544c4142"
        "5f636c617373z4.130100000600000001z7.646f75626c65z260.1840z7.40z6.2040z6.1040z6.2440z6.f03fz6.1c40z"
        "6.0840z6.2240z6.1440z6.2640");
    return bytes;
}
const Bytes& chunked_mat73() {
    static const Bytes bytes = mat73(
        "894844460d0a1a0az5.080800040010z6.02z6.ffffffffffffffff281bz6.ffffffffffffffffz8.60z7.01z7.88z7.a8"
        "02z6.010001000100000018z7.110010z5.88z7.a802z6.5452454500000100ffffffffffffffffffffffffffffffffz8."
        "4004z6.10z1f7.48454150z4.58z7.18z7.c802ze.6669656c640000006c616d626461000001z7.40z37.0100080001000"
        "0001001z6.010028z5.010201z5.02z7.03z7.02z7.03z7.030080000100000016020000100000007265616cz24.11203f"
        "0008z5.4000340b0034ff030000696d6167z4.08z1f.11203f0008z5.4000340b0034ff030000050008000100000002030"
        "001z4.0b002000010000000101z6.01000800010001006465666c6174650003z7.100010z5.c00fz6.58zf.534e4f44010"
        "0020008z7.2003z1e.10z7.1818z10e.5452454501000400ffffffffffffffffffffffffffffffff13z1f.1810z6.16zf."
        "02zf.2b10z6.18z7.01z17.4110z6.16z7.01z7.02zf.5910ze.01z7.02z7.10z967.080018z5.0302038805z6.0100000"
        "00200000010z4.0c0030z5.01000d00080008004d41544c41425f636c617373z4.130100000600000001z7.646f75626c6"
        "50000785e63604006120e501e945670000008d000f9785e63600001010730c5a002a5213c1000000ec800b5785e6360008"
        "10ff6608a41c6014273406925070027f30236785e63600001110730c5a006a5213c1000000f5400bb4b0484b86d3da53ez"
        "7a1.0100060001z4.01z6.010028z5.010201z5.01z7.01z7.01z7.01z7.030018000100000011203f0008z5.4000340b0"
        "034ff03z6.050008000100000002020201z4.080018z5.03016f10z6.08zd.0c0030z5.01000d00080008004d41544c414"
        "25f636c617373z4.130100000600000001z7.646f75626c65z4.40z45.");
    return bytes;
}

Bytes npy(const std::string& type, bool by_columns, const std::function<void(Bytes&)>& numbers) {
    std::string header =
        "{'descr': '" + type + "', 'fortran_order': " + (by_columns ? "True" : "False") + ", 'shape': (3, 2), }";
    header.resize(117, ' ');
    header += '\n';
    const std::string all = "\x93NUMPY\1" + std::string(1, '\0') + static_cast<char>(header.size()) + '\0' + header;
    Bytes bytes(all.begin(), all.end());
    numbers(bytes);
    return bytes;
}
template <class T>
void put(Bytes& bytes, T value) {
    const auto* begin = reinterpret_cast<const unsigned char*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof value);
}
Bytes npy_rows() {
    return npy("<c8", false, [](Bytes& bytes) {
        for (int i = 0; i < 6; ++i) {
            put(bytes, static_cast<float>(i));
            put(bytes, static_cast<float>(i + 6));
        }
    });
}

void expect_example(const FieldSource& field, double sign = 1) {
    ASSERT_EQ(field.grid().plane.width, 2u);
    ASSERT_EQ(field.grid().plane.height, 3u);
    EXPECT_EQ(field.grid().wavelength, 633e-9);
    EXPECT_EQ(field.grid().plane.pitch_x, 2e-6);
    const Array<Complex, 2> samples = all_of(field);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(samples.data()[i], Complex(float(i), float(sign * double(i + 6)))) << i;
}

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
    for (const char* shape : {"(2, 2, 2)", "(3, 2, 2, 1)", "(60,)", "(3, 4, 6)", "(4, 5, 3", "()"})
        EXPECT_THROW(external_facts(write("bad.npy", shaped(shape, [](Bytes& b) { b.resize(b.size() + 240); }))), Error)
            << shape;
}

// Expects that opening the field is refused because the build lacks a part.
void expect_not_built_in(const fs::path& path, const ExternalField& what, const std::string& option) {
    try {
        open_external_field(path, what);
        ADD_FAILURE() << path << " was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::not_built_in) << error.what();
        EXPECT_NE(std::string(error.what()).find(option), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    }
}

TEST_F(ExternalFields, of_matlab_are_read_plain_and_compressed) {
    expect_example(*open_external_field(write("a.mat", plain_mat()), known()));
    if (!core::part("zlib").built_in) {
        expect_example(*open_external_field(write("d.mat", plain_mat73()), known()));
        expect_not_built_in(write("b.mat", compressed_mat()), known(), "HOGEL_ZLIB");
        expect_not_built_in(write("e.mat", chunked_mat73()), known(), "HOGEL_ZLIB");
        return;
    }
    expect_example(*open_external_field(write("b.mat", compressed_mat()), known()));
    expect_example(*open_external_field(write("c.mat", two_arrays_mat()), known()));  // the complex one of two
    ExternalField which = known();
    which.variable = "a";
    expect_example(*open_external_field(directory_ / "c.mat", which));
    expect_example(*open_external_field(write("d.mat", plain_mat73()), known()));
    expect_example(*open_external_field(write("e.mat", chunked_mat73()), known()));
    which.variable = "field";
    expect_example(*open_external_field(directory_ / "e.mat", which));
    which.variable = "missing";
    EXPECT_THROW(open_external_field(directory_ / "e.mat", which), Error);
    EXPECT_THROW(open_external_field(directory_ / "c.mat", which), Error);
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

// HDF5 reserves space for later content, zeros far from other data, which are never read.
bool is_padding(const Bytes& bytes, std::size_t at) {
    constexpr std::size_t far = 4;
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at - std::min(at, far));
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at + far, bytes.size()));
    return std::all_of(begin, end, [](unsigned char byte) { return byte == 0; });
}

// A damaged file is either refused or read as some field, without a crash.
TEST_F(ExternalFields, in_damaged_files_are_refused_or_read) {
    const fs::path path = directory_ / "x";
    ExternalField what = known();
    const bool complete = core::part("zlib").built_in && core::part("pictures").built_in;
    std::size_t refused = 0, read = 0;
    const auto attempt = [&](const Bytes& bytes) {
        {
            fs::remove(path);  // some file systems flush a file that is truncated and written again
            std::ofstream file(path, std::ios::binary);
            file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        }
        try {
            const auto field = open_external_field(path, what);
            ASSERT_LE(field->grid().plane.samples(), 1000u);
            all_of(*field);
            ++read;
        } catch (const Error& error) {
            ASSERT_TRUE(error.code() == ErrorCode::bad_input || error.code() == ErrorCode::usage ||
                        (error.code() == ErrorCode::not_built_in && !complete))
                << error.what();
            ++refused;
        }
    };
    for (const Bytes& whole :
         {npy_rows(), plain_mat(), compressed_mat(), two_arrays_mat(), plain_mat73(), chunked_mat73()}) {
        const std::size_t before = refused;
        const std::size_t head = whole[0] == 0x93 ? 6 : 128;  // shorter files are treated as pictures
        std::size_t cut = 0;
        for (std::size_t length = head; length < whole.size(); ++length) {
            if (is_padding(whole, length)) continue;
            attempt(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
            ++cut;
        }
        EXPECT_GE(refused - before, cut / 2);
        for (std::size_t at = std::min<std::size_t>(head, 120); at < whole.size(); ++at) {
            if (is_padding(whole, at)) continue;
            constexpr int flips[] = {0x01, 0x90, 0xff};
            const std::size_t one = at % 3;  // in larger files each byte is damaged in only one way
            for (int flip : whole.size() < 1000 ? std::span(flips) : std::span(flips).subspan(one, 1)) {
                Bytes damaged = whole;
                damaged[at] = static_cast<unsigned char>(damaged[at] ^ flip);
                attempt(damaged);
            }
        }
    }
    EXPECT_GT(read, 100u);
}

}  // namespace
}  // namespace hogel::io::arrays
