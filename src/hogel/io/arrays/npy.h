// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
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

/// The beginning of an .npy file of an array by rows; `type` is NumPy's: "<f4".
std::string npy_beginning(const std::string& type, std::span<const std::size_t> shape);

}  // namespace hogel::io::arrays
