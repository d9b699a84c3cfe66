#include "hogel/io/foreign.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <string_view>

#include "hogel/core/error.h"
#include "hogel/core/output_file.h"
#include "hogel/image/image.h"
#include "hogel/image/levels.h"

namespace hogel {
namespace {

namespace fs = std::filesystem;
using Complex = std::complex<float>;
using Bytes = std::vector<unsigned char>;
using Values = ForeignField::Values;

class Foreign : public testing::Test {
  protected:
    Foreign() { fs::create_directories(directory_); }
    ~Foreign() override { fs::remove_all(directory_); }

    fs::path write(const char* name, const Bytes& bytes) const {
        write_file(directory_ / name, bytes);
        return directory_ / name;
    }

    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_foreign_" + std::to_string(::getpid()));
};

ForeignField known(Values values = Values::complex) {
    ForeignField what;
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

Bytes from_hex(std::string_view hex) {
    Bytes bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2)
        bytes.push_back(static_cast<unsigned char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
    return bytes;
}

// Three rows of two columns: row by row 0 + 6i, 1 + 7i, 2 + 8i, … as scipy 1.10 writes it.
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
const Bytes& compressed_mat() {  // and a wavelength beside the array
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

TEST_F(Foreign, arrays_of_numpy_are_read_by_rows_and_by_columns) {
    expect_example(*open_foreign_field(write("a.npy", npy_rows()), known()));
    const Bytes columns = npy("<c16", true, [](Bytes& bytes) {
        for (int column = 0; column < 2; ++column)
            for (int row = 0; row < 3; ++row) {
                put(bytes, double(2 * row + column));
                put(bytes, double(2 * row + column + 6));
            }
    });
    const auto field = open_foreign_field(write("b.npy", columns), known());
    expect_example(*field);
    Array<Complex, 2> corner({2, 1});
    field->read({1, 1, 1, 2}, 0, corner);
    EXPECT_EQ(corner(1, 0), Complex(5, 11));
    ForeignField other = known();
    other.conjugate = true;
    expect_example(*open_foreign_field(directory_ / "b.npy", other), -1);
    EXPECT_TRUE(is_foreign_array(directory_ / "b.npy"));
}

TEST_F(Foreign, arrays_are_written_as_numpy_writes_them) {
    const auto field = open_foreign_field(write("a.npy", npy_rows()), known());
    write_npy(directory_ / "b.npy", all_of(*field));
    std::ifstream a(directory_ / "a.npy", std::ios::binary), b(directory_ / "b.npy", std::ios::binary);
    EXPECT_TRUE(std::equal(std::istreambuf_iterator<char>(a), {}, std::istreambuf_iterator<char>(b), {}));
}

TEST_F(Foreign, arrays_of_matlab_are_read_plain_and_compressed) {
    expect_example(*open_foreign_field(write("a.mat", plain_mat()), known()));
    expect_example(*open_foreign_field(write("b.mat", compressed_mat()), known()));
    EXPECT_THROW(open_foreign_field(write("c.mat", two_arrays_mat()), known()), Error);
    ForeignField which = known();
    which.variable = "a";
    expect_example(*open_foreign_field(directory_ / "c.mat", which));
    which.variable = "missing";
    EXPECT_THROW(open_foreign_field(directory_ / "c.mat", which), Error);
}

TEST_F(Foreign, real_numbers_are_amplitudes_or_phases_as_is_said) {
    const auto reals = [](const char* type, auto first) {
        return npy(type, false, [&](Bytes& bytes) {
            for (int i = 0; i < 6; ++i) put(bytes, static_cast<decltype(first)>(i));
        });
    };
    const fs::path radians = write("f.npy", reals("<f4", float())),
                   codes = write("u.npy", reals("<u2", std::uint16_t()));
    EXPECT_THROW(open_foreign_field(radians, known()), Error);
    EXPECT_THROW(open_foreign_field(write("a.npy", npy_rows()), known(Values::phase)), Error);
    const auto at = [](const fs::path& path, Values values) {
        return all_of(*open_foreign_field(path, known(values)))(2, 0);
    };
    EXPECT_EQ(at(radians, Values::amplitude), Complex(4));
    EXPECT_LT(std::abs(at(radians, Values::phase) - std::polar(1.0f, 4.0f)), 1e-6f);
    EXPECT_LT(std::abs(at(codes, Values::phase) - std::polar(1.0f, float(2 * std::numbers::pi * 4 / 65536))), 1e-6f);
}

TEST_F(Foreign, pictures_are_codes_of_phases_amplitudes_or_two_parts) {
    Array<std::uint8_t, 3> levels({3, 2, 1});
    for (std::size_t i = 0; i < 6; ++i) levels.data()[i] = static_cast<std::uint8_t>(50 * i);
    write_levels(directory_ / "p.png", levels);
    const auto phases = all_of(*open_foreign_field(directory_ / "p.png", known(Values::phase)));
    const auto amplitudes = all_of(*open_foreign_field(directory_ / "p.png", known(Values::amplitude)));
    for (std::size_t i = 0; i < 6; ++i) {
        const auto turn = static_cast<float>(2 * std::numbers::pi * 50.0 * double(i) / 256);
        EXPECT_LT(std::abs(phases.data()[i] - std::polar(1.0f, turn)), 1e-6f) << i;
        EXPECT_EQ(amplitudes.data()[i], Complex(50 * float(i))) << i;
    }
    Image real(2, 3, 1), imaginary(2, 3, 1);
    for (std::size_t i = 0; i < 6; ++i) {
        real.pixels.data()[i] = float(i);
        imaginary.pixels.data()[i] = float(i + 6);
    }
    write_image(directory_ / "r.exr", real);
    write_image(directory_ / "i.exr", imaginary);
    ForeignField what = known();
    what.imaginary = directory_ / "i.exr";
    expect_example(*open_foreign_field(directory_ / "r.exr", what));
    write_image(directory_ / "small.exr", Image(1, 3, 1));
    what.imaginary = directory_ / "small.exr";
    EXPECT_THROW(open_foreign_field(directory_ / "r.exr", what), Error);
}

// Damage is refused as such, or gives some field: nothing else.
TEST_F(Foreign, damaged_files_are_refused_or_harmless) {
    const fs::path path = directory_ / "x";
    ForeignField what = known();
    std::size_t refused = 0, read = 0;
    const auto attempt = [&](const Bytes& bytes) {
        {
            fs::remove(path);  // a file that is cut short and written anew is flushed to the disk each time
            std::ofstream file(path, std::ios::binary);
            file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        }
        try {
            const auto field = open_foreign_field(path, what);
            ASSERT_LE(field->grid().plane.samples(), 1000u);
            all_of(*field);
            ++read;
        } catch (const Error& error) {
            ASSERT_TRUE(error.code() == ErrorCode::bad_input || error.code() == ErrorCode::usage) << error.what();
            ++refused;
        }
    };
    for (const Bytes& whole : {npy_rows(), plain_mat(), compressed_mat(), two_arrays_mat()}) {
        const std::size_t before = refused;
        const std::size_t head = whole[0] == 0x93 ? 6 : 128;  // with less it is taken for a picture
        for (std::size_t length = head; length < whole.size(); ++length)
            attempt(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
        EXPECT_GE(refused - before, (whole.size() - head) / 2);
        for (std::size_t at = std::min<std::size_t>(head, 120); at < whole.size(); ++at)
            for (int flip : {0x01, 0x90, 0xff}) {
                Bytes damaged = whole;
                damaged[at] = static_cast<unsigned char>(damaged[at] ^ flip);
                attempt(damaged);
            }
    }
    EXPECT_GT(read, 100u);
}

}  // namespace
}  // namespace hogel
