// SPDX-License-Identifier: Apache-2.0
// Fields in MAT files as other programs write them, and damaged files.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <span>
#include <string_view>

#include "hogel/core/part.h"
#include "hogel/io/arrays/mat_write.h"
#include "hogel/io/arrays/test_field_files.h"

namespace hogel::io::arrays {
namespace {

using MatlabFields = FieldFiles;

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

TEST_F(MatlabFields, are_read_plain_and_compressed) {
    expect_example(*open_external_field(write("a.mat", plain_mat()), known()));
    if (!core::part("zlib").built_in) {
        expect_not_built_in(write("b.mat", compressed_mat()), known(), "HOGEL_ZLIB");
        return;
    }
    expect_example(*open_external_field(write("b.mat", compressed_mat()), known()));
    expect_example(*open_external_field(write("c.mat", two_arrays_mat()), known()));  // the complex one of two
    ExternalField which = known();
    which.variable = "a";
    expect_example(*open_external_field(directory_ / "c.mat", which));
    which.variable = "missing";
    EXPECT_THROW(open_external_field(directory_ / "c.mat", which), Error);
}

TEST_F(MatlabFields, of_version_73_are_read_plain_and_compressed) {
    const fs::path plain = write("d.mat", plain_mat73()), packed = write("e.mat", chunked_mat73());
    if (!core::part("HDF5").built_in) {
        for (const fs::path& path : {plain, packed}) expect_not_built_in(path, known(), "HOGEL_HDF5");
        return;
    }
    expect_example(*open_external_field(plain, known()));
    expect_example(*open_external_field(packed, known()));
    ExternalField which = known();
    which.variable = "field";
    expect_example(*open_external_field(packed, which));
    which.variable = "missing";
    EXPECT_THROW(open_external_field(packed, which), Error);
}

// An element of a MAT file that zlib's format holds, in blocks that are not deflated, without its checksum.
Bytes stored(std::span<const unsigned char> array) {
    Bytes packed{0x78, 0x01};
    for (std::size_t at = 0; at < array.size();) {
        const std::size_t size = std::min<std::size_t>(array.size() - at, 0xffff);
        for (const std::size_t part :
             {std::size_t{at + size == array.size()}, size & 0xff, size >> 8, ~size & 0xff, ~size >> 8 & 0xff})
            packed.push_back(static_cast<unsigned char>(part));
        packed.insert(packed.end(), &array[at], &array[at] + size);
        at += size;
    }
    return packed;
}

void put_compressed(Bytes& file, const Bytes& packed) {
    for (const std::size_t number : {std::size_t{15}, packed.size()})
        for (std::size_t i = 0; i < 4; ++i) file.push_back(static_cast<unsigned char>(number >> (8 * i)));
    file.insert(file.end(), packed.begin(), packed.end());
}

// Facts are requested before the numbers; arrays used to be inflated for each request.
TEST_F(MatlabFields, are_inflated_only_where_their_numbers_are_read) {
    if (!core::part("zlib").built_in) GTEST_SKIP() << "no zlib";
    const std::vector<float> numbers(20 * 30, 0.5f);
    const auto array_of = [&](const std::string& name) {
        MatWriter writer("x.mat");
        const Bytes empty = writer.bytes();
        writer.array(name, std::vector<std::size_t>{20, 30}, numbers, numbers);
        return std::pair(empty, Bytes(writer.bytes().begin() + static_cast<long>(empty.size()), writer.bytes().end()));
    };
    const auto [header, field] = array_of("field");
    Bytes damaged = stored(array_of("other").second);
    damaged.resize(damaged.size() - 1000);  // behind the head of the array
    Bytes file = header;
    put_compressed(file, damaged);
    const fs::path one = write("one.mat", file);
    EXPECT_EQ(external_facts(one).width, 30u);
    EXPECT_EQ(external_facts(one).numbers, "complex, single floats");
    EXPECT_THROW(open_external_field(one, known()), Error);
    put_compressed(file, stored(field));
    ExternalField which = known();
    which.variable = "field";
    EXPECT_EQ(all_of(*open_external_field(write("two.mat", file), which))(19, 29), Complex(0.5f, 0.5f));
    // Real numbers stay in the inflated buffer.
    MatWriter real("x.mat");
    real.array("field", std::vector<std::size_t>{20, 30}, numbers);
    file = header;
    put_compressed(file, stored(std::span(real.bytes()).subspan(header.size())));
    EXPECT_EQ(all_of(*open_external_field(write("three.mat", file), known(Values::amplitude)))(19, 29), Complex(0.5f));
}

// HDF5 reserves space for later content, zeros far from other data, which are never read.
bool is_padding(const Bytes& bytes, std::size_t at) {
    constexpr std::size_t far = 4;
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at - std::min(at, far));
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at + far, bytes.size()));
    return std::all_of(begin, end, [](unsigned char byte) { return byte == 0; });
}

// Files of version 7.3 are read in child processes, so that few are tried unless HOGEL_THOROUGH is in the environment.
std::size_t stride_of(const Bytes& whole) {
    const bool slow = whole.size() > 512 && whole[125] == 2;
    return slow && std::getenv("HOGEL_THOROUGH") == nullptr ? 12 : 1;
}

// A damaged file is either refused or read as some field, without a crash.
TEST_F(MatlabFields, in_damaged_files_are_refused_or_read) {
    const fs::path path = directory_ / "x";
    ExternalField what = known();
    const bool complete = core::part("zlib").built_in && core::part("pictures").built_in && core::part("HDF5").built_in;
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
        const std::size_t stride = stride_of(whole);
        std::size_t cut = 0;
        for (std::size_t length = head; length < whole.size(); length += stride) {
            if (is_padding(whole, length)) continue;
            attempt(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
            ++cut;
        }
        EXPECT_GE(refused - before, cut / 2);
        for (std::size_t at = std::min<std::size_t>(head, 120); at < whole.size(); at += stride) {
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
