// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {

/// An array of a MAT file: two axes, column after column, as MATLAB keeps them.
struct MatArray {
    std::string name;
    std::size_t height = 0, width = 0;
    Number real_number = Number::real, imaginary_number = Number::real;
    bool floating = false;  ///< whether its class in MATLAB is single or double, however its numbers are stored
    std::vector<unsigned char> real, imaginary;  ///< imaginary: empty where the array is real
};

/// The numeric arrays of two axes and more than one element in the bytes of a MAT file of version 5; those of this
/// name, if it is not empty. Throws Error(bad_input).
std::vector<MatArray> read_mat5(const std::filesystem::path& path, std::span<const unsigned char> bytes,
                                const std::string& name);

/// The same for a MAT file of version 7.3.
std::vector<MatArray> read_mat73(const std::filesystem::path& path, const std::string& name);

}  // namespace hogel::io::arrays
