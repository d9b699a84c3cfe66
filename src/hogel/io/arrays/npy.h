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

/// What the header of a NumPy array says.
struct NpyHeader {
    Number number = Number::real;
    bool complex = false, by_columns = false, big_endian = false;
    std::vector<std::size_t> shape;  ///< one extent an axis
    std::uint64_t begin = 0;         ///< offset of the numbers

    std::size_t bytes_of_sample() const { return bytes_of(number) * (complex ? 2 : 1); }
};

/// Reads the header of an .npy file whose numbers are all there. Throws Error(bad_input).
NpyHeader read_npy_header(const std::filesystem::path& path, const core::RawFile& file);
/// As above, of a file of `size` bytes which begins with these.
NpyHeader parse_npy_header(const std::filesystem::path& path, std::span<const unsigned char> start, std::uint64_t size);
/// Whether an .npy file is an array of numbers of a type that is read.
bool npy_holds_numbers(const std::filesystem::path& path, std::span<const unsigned char> start);
/// How much of a file parse_npy_header() may look at.
constexpr std::size_t npy_start = 12 + (1 << 16);

/// The beginning of an .npy file of an array by rows; `type` is NumPy's: "<f4".
std::string npy_beginning(const std::string& type, std::span<const std::size_t> shape);

}  // namespace hogel::io::arrays
