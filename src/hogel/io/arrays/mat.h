// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {

/// An array of a MAT file with two axes, stored column by column as in MATLAB.
struct MatArray {
    std::string name;
    std::size_t height = 0, width = 0;
    Number real_number = Number::real, imaginary_number = Number::real;
    bool floating =
        false;  ///< whether its class in MATLAB is single or double, regardless of how its numbers are stored
    std::vector<unsigned char> real, imaginary;  ///< `imaginary` is empty if the array is real
};

/// Reads the numeric arrays with two axes and more than one element from a MAT file of version 5; if `name` is not
/// empty, those of that name. Throws Error(bad_input).
std::vector<MatArray> read_mat5(const std::filesystem::path& path, std::span<const unsigned char> bytes,
                                const std::string& name);

/// As read_mat5(), for a MAT file of version 7.3.
std::vector<MatArray> read_mat73(const std::filesystem::path& path, const std::string& name);

}  // namespace hogel::io::arrays
