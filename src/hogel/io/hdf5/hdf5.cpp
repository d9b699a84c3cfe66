// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <mutex>

#include "hogel/error.h"
#include "hogel/io/hdf5/files.h"
#include "hogel/io/hdf5/hdf5.h"

namespace hogel::io::hdf5 {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they are in memory");

// Sessions nest in a thread. A recursive mutex would not recognise its owner in a child (rehearsal.h).
std::mutex& process_mutex() {
    static std::mutex mutex;
    return mutex;
}
thread_local int sessions = 0;  // nesting depth in this thread

std::uint64_t little_endian(const unsigned char* bytes, int n) {
    std::uint64_t value = 0;
    for (int i = n - 1; i >= 0; --i) value = value << 8 | bytes[i];
    return value;
}

// Rejects files that could crash HDF5, which does not validate its input: files without checksums (superblock before
// version 2), and files with a superblock extension, which neither hogel nor h5py writes. HDF5 file format
// specification 3.0, II.A; all numbers are little-endian.
void check_superblock(const std::filesystem::path& path) {
    std::array<unsigned char, 48> start{};
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(start.data()), start.size());
    if (file.gcount() != static_cast<std::streamsize>(start.size())) fail(path, "it ends inside its header");
    const int version = start[8];
    if (version < 2 || version > 3)
        fail(path, fmt::format("its HDF5 superblock has version {}, but 2 or 3 was expected (h5py writes it for "
                               "libver='v108')",
                               version));
    if (start[9] != 8 || start[10] != 8) fail(path, "its HDF5 superblock is damaged: addresses are not of 8 bytes");
    constexpr std::uint64_t undefined = ~std::uint64_t{0};
    if (little_endian(&start[12], 8) != 0 || little_endian(&start[20], 8) != undefined)
        fail(path, "its HDF5 superblock has a base address or an extension; expected neither");
    const std::uint64_t size = std::filesystem::file_size(path), end = little_endian(&start[28], 8),
                        root = little_endian(&start[36], 8);
    if (size < end) fail(path, fmt::format("it is truncated: {} bytes instead of {}", size, end));
    std::array<char, 4> signature{};
    if (root >= end || !file.seekg(static_cast<std::streamoff>(root)).read(signature.data(), 4) ||
        std::memcmp(signature.data(), "OHDR", 4) != 0)
        fail(path, "its HDF5 superblock is damaged: it does not lead to a root group");
}

}  // namespace

Session::Session() {
    if (sessions++ == 0) process_mutex().lock();
    // HDF5 1.10 fails and prints errors at exit after a wrong checksum. Handles close all files.
    static const herr_t first_call = H5dont_atexit();
    static_cast<void>(first_call);
    H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Session::~Session() {
    H5Eset_auto2(H5E_DEFAULT, print_, print_data_);
    if (--sessions == 0) process_mutex().unlock();
}

std::string reason() {
    std::string text = "HDF5 gave no reason";
    const auto keep_first = [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
        if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return text;
}

void fail(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': {}", path.string(), why));
}

Handle open_unchecked_file(const std::filesystem::path& path) {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access.id(), false, true);  // files with their final name are never modified
    Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
    if (!file.valid()) fail(path, fmt::format("it is damaged: {}", reason()));
    return file;
}

Handle open_file(const std::filesystem::path& path) {
    if (!is_hdf5(path)) fail(path, "it is not an HDF5 file");
    check_superblock(path);
    return open_unchecked_file(path);
}

std::size_t bytes_of(Element element) {
    switch (element) {
        case Element::half:
            return 2;
        case Element::single:
            return 4;
        case Element::complex_single:
            break;
    }
    return 8;
}

Handle type_of(Element element) {
    switch (element) {
        case Element::half: {
            Handle type(H5Tcopy(H5T_IEEE_F32LE), H5Tclose);
            H5Tset_fields(type.id(), 15, 10, 5, 0, 10);
            H5Tset_size(type.id(), 2);
            H5Tset_ebias(type.id(), 15);
            return type;
        }
        case Element::single:
            return {H5Tcopy(H5T_IEEE_F32LE), H5Tclose};
        case Element::complex_single:
            break;
    }
    Handle type(H5Tcreate(H5T_COMPOUND, 8), H5Tclose);
    H5Tinsert(type.id(), "r", 0, H5T_IEEE_F32LE);
    H5Tinsert(type.id(), "i", 4, H5T_IEEE_F32LE);
    return type;
}

}  // namespace hogel::io::hdf5
