// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hogel/core/raw_file.h"
#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {

struct NpyHeader {
    Number number = Number::real;
    bool complex = false, by_columns = false, big_endian = false;
    std::vector<std::size_t> shape;
    std::uint64_t begin = 0;  ///< offset of the numbers

    std::size_t bytes_of_sample() const { return bytes_of(number) * (complex ? 2 : 1); }
};

/// Reads the header of an .npy file. Throws Error(bad_input) if it is damaged or numbers are missing.
NpyHeader read_npy_header(const std::filesystem::path& path, const core::RawFile& file);
/// As read_npy_header(), for a file of `size` bytes that begins with `start`.
NpyHeader parse_npy_header(const std::filesystem::path& path, std::span<const unsigned char> start, std::uint64_t size);
/// Returns whether an .npy file holds numbers of a supported type.
bool npy_holds_numbers(const std::filesystem::path& path, std::span<const unsigned char> start);
/// Maximum number of bytes that parse_npy_header() needs.
constexpr std::size_t npy_start = 12 + (1 << 16);

/// Returns the beginning of an .npy file of a row-major array; `type` is NumPy's: "<f4".
std::string npy_beginning(const std::string& type, std::span<const std::size_t> shape);

}  // namespace hogel::io::arrays
